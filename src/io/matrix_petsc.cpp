#include <Eigen/SparseCore>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "io/matrix_writers.h"

namespace tufted::io {
namespace {

// What each kind of object begins with.
constexpr std::int32_t matrix_mark = 1211216;
constexpr std::int32_t vector_mark = 1211214;

/// Writes numbers with the most significant byte first.
template <class Number>
void writeBigEndian(OutputFile& file, const Number* numbers, std::size_t count) {
  constexpr std::size_t most = 8192;
  std::vector<char> bytes;
  for (std::size_t first = 0; first < count; first += most) {
    const std::size_t size = std::min(most, count - first);
    bytes.resize(size * sizeof(Number));
    std::memcpy(bytes.data(), numbers + first, bytes.size());
    for (auto number = bytes.begin(); number != bytes.end(); number += sizeof(Number))
      std::reverse(number, number + sizeof(Number));
    file.write(bytes.data(), bytes.size());
  }
}

}  // namespace

void writePetsc(const OutputPath& to, const SparseMatrix& matrix) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t> rows = matrix;
  std::vector<std::int32_t> head = {matrix_mark, static_cast<std::int32_t>(rows.rows()),
                                    static_cast<std::int32_t>(rows.cols()), static_cast<std::int32_t>(rows.nonZeros())};
  for (Eigen::Index i = 0; i < rows.rows(); ++i) head.push_back(rows.outerIndexPtr()[i + 1] - rows.outerIndexPtr()[i]);
  const auto entries = static_cast<std::size_t>(rows.nonZeros());
  OutputFile file(to);
  writeBigEndian(file, head.data(), head.size());
  writeBigEndian(file, rows.innerIndexPtr(), entries);
  writeBigEndian(file, rows.valuePtr(), entries);
  file.close();
}

void writePetsc(const OutputPath& to, const VectorXd& values) {
  const std::int32_t head[] = {vector_mark, static_cast<std::int32_t>(values.size())};
  OutputFile file(to);
  writeBigEndian(file, head, 2);
  writeBigEndian(file, values.data(), static_cast<std::size_t>(values.size()));
  file.close();
}

}  // namespace tufted::io
