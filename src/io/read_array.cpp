#include <string>

#include "io/errors.h"
#include "io/file_text.h"
#include "io/npy_table.h"
#include "tufted/io/results.h"

Eigen::MatrixXd tufted::readArray(const std::filesystem::path& path) {
  const std::string bytes = io::readBytes(path);
  const io::NpyTable array = io::parseNpyTable(bytes, bytes.size(), path, true);
  if (array.dimensions > 2) io::refuse(path, "is not an array of N or of N x c values");
  if (array.end < bytes.size())
    io::refuseByte(path, array.end, std::to_string(bytes.size() - array.end) + " bytes behind the values of the array");
  Eigen::MatrixXd values(array.rows(), array.columns);
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    const Field column = array.field(c);
    for (Eigen::Index i = 0; i < values.rows(); ++i) values(i, c) = valueOf(column, static_cast<std::size_t>(i));
  }
  return values;
}
