#include "io/matrix_file.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "io/errors.h"

namespace tufted::io {
namespace {

/// Collects the columns of a sparse matrix, one entry after another.
class ColumnBuilder {
 public:
  explicit ColumnBuilder(int rows) : place_(rows, -1) {}

  void add(int row, double value) {
    const auto next = static_cast<int>(rows_.size());
    int& place = place_[row];
    if (place >= begin_) {
      values_[place] += value;
      return;
    }
    place = next;
    rows_.push_back(row);
    values_.push_back(value);
  }

  void endColumn() {
    const auto begin = rows_.begin() + begin_;
    if (!std::is_sorted(begin, rows_.end())) {
      std::sort(begin, rows_.end());
      sorted_.clear();
      for (auto row = begin; row != rows_.end(); ++row) sorted_.push_back(values_[place_[*row]]);
      std::copy(sorted_.begin(), sorted_.end(), values_.begin() + begin_);
    }
    begin_ = static_cast<int>(rows_.size());
    ends_.push_back(begin_);
  }

  SparseMatrix matrix() const {
    SparseMatrix matrix(static_cast<int>(place_.size()), static_cast<int>(ends_.size()));
    matrix.resizeNonZeros(std::ssize(rows_));
    std::copy(ends_.begin(), ends_.end(), matrix.outerIndexPtr() + 1);
    std::copy(rows_.begin(), rows_.end(), matrix.innerIndexPtr());
    std::copy(values_.begin(), values_.end(), matrix.valuePtr());
    return matrix;
  }

 private:
  std::vector<int> place_;  ///< place of the last entry in each row; if below begin_, in an earlier column
  int begin_ = 0;           ///< place of the current column's first entry
  std::vector<int> ends_, rows_;
  std::vector<double> values_, sorted_;
};

}  // namespace

MatrixFile::MatrixFile(const std::filesystem::path& path)
    : path_(path),
      archive_(path),
      starts_(archive_.open("indptr")),
      indices_(archive_.open("indices")),
      values_(archive_.open("data")) {
  const std::string format = archive_.text("format");
  by_rows_ = format.starts_with("csr");
  if (!by_rows_ && !format.starts_with("csc"))
    refuse(path, "is a matrix of the format " + quote(format) + ", must be csc or csr");
  const std::vector<double> shape = archive_.numbers("shape", 2);
  constexpr double most = std::numeric_limits<int>::max();
  if (shape[0] != shape[1]) refuse(path, "holds no square matrix");
  rows_ = integersOf(shape, 0, most - 1, path)[0];
  if (starts_.size() != rows_ + std::int64_t{1} || indices_.size() != values_.size() || indices_.size() > most)
    refuse(path, "has columns that do not fit its entries");
}

std::vector<int> MatrixFile::readStarts() {
  std::vector<int> starts;
  for (std::int64_t j = 0; j < starts_.size(); ++j) {
    starts.push_back(starts_.nextInteger(0, static_cast<double>(indices_.size())));
    // A column with more entries than rows, which must repeat some, is refused.
    const int before = j == 0 ? 0 : starts[j - 1];
    if (starts[j] < before || starts[j] - before > (j == 0 ? 0 : rows_))
      refuse(path_, "has columns that do not fit its entries");
  }
  if (starts.back() != indices_.size()) refuse(path_, "has columns that do not fit its entries");
  return starts;
}

SparseMatrix MatrixFile::read() {
  const std::vector<int> starts = readStarts();
  ColumnBuilder columns(rows_);
  for (int j = 0; j < rows_; ++j) {
    for (int k = starts[j]; k < starts[j + 1]; ++k) {
      const int row = indices_.nextInteger(0, rows_ - 1.0);
      columns.add(row, values_.next());
    }
    columns.endColumn();
  }
  if (!by_rows_) return columns.matrix();
  return SparseMatrix(columns.matrix().transpose());
}

}  // namespace tufted::io
