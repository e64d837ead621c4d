#include <limits>
#include <string>
#include <vector>

#include "io/errors.h"
#include "io/formats.h"
#include "io/npy.h"

namespace tufted::io {

bool looksLikeNpy(std::string_view bytes) {
  return bytes.starts_with("\x93NUMPY");
}

Geometry readNpy(const std::filesystem::path& path, std::string_view bytes) {
  const NpyArray array = parseNpy(bytes, path, NpyOrder::any);
  const FieldType type = numberType(array, path);
  if (type != FieldType::float32 && type != FieldType::float64)
    refuseByte(path, npy_dictionary, "is an array of " + quote(array.descr) + ", must be of float32 or float64");
  if (array.shape.size() != 2 || array.shape[1] != 3) {
    std::string shape;
    for (const std::int64_t length : array.shape) shape += (shape.empty() ? "" : " x ") + std::to_string(length);
    refuseByte(path, npy_dictionary,
               "is an array of " + (shape.empty() ? "one value" : shape) + ", must be N x 3: a point per row");
  }
  if (array.shape[0] > std::numeric_limits<int>::max())
    refuseByte(path, npy_dictionary, "has more than 2^31 - 1 points");
  const std::vector<double> numbers = numbersOf(array, path);
  Geometry geometry;
  geometry.format = std::string("NPY, ") + (type == FieldType::float32 ? "float32" : "float64");
  geometry.points.resize(array.shape[0], 3);
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  if (array.is_by_columns)
    geometry.points = Eigen::Map<const Columns>(numbers.data(), array.shape[0], 3);
  else
    geometry.points = Eigen::Map<const Points>(numbers.data(), array.shape[0], 3);
  geometry.width = static_cast<int>(geometry.points.rows());
  return geometry;
}

}  // namespace tufted::io
