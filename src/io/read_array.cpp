#include <string>
#include <vector>

#include "io/errors.h"
#include "io/file_text.h"
#include "io/npy.h"
#include "tufted/io/results.h"

Eigen::MatrixXd tufted::readArray(const std::filesystem::path& path) {
  const std::string bytes = io::readBytes(path);
  const io::NpyArray array = io::parseNpy(bytes, path);
  if (array.shape.empty() || array.shape.size() > 2) io::refuse(path, "is not an array of N or of N x c values");
  const std::vector<double> numbers = io::numbersOf(array, path);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(numbers.data(), array.shape[0], array.shape.size() == 2 ? array.shape[1] : 1);
}
