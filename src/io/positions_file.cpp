#include "io/positions_file.h"

#include <string>

#include "io/errors.h"
#include "io/file_text.h"
#include "io/npy.h"

namespace tufted::io {

void writePositions(const OutputPath& to, const Points& positions) {
  OutputFile file(to);
  file.write(npyHeader("<f8", {positions.rows(), 3}));
  file.write(positions.data(), static_cast<std::size_t>(positions.size()) * sizeof(double));
  file.close();
}

Points readPositions(const std::filesystem::path& path, std::size_t points) {
  const std::string bytes = readBytes(path);
  const NpyArray array = parseNpy(bytes, path);
  const auto n = static_cast<std::int64_t>(points);
  if (array.shape.size() != 2 || array.shape[1] != 3 || (array.shape[0] != n && array.shape[0] != 0))
    refuse(path, "is not an array of " + std::to_string(n) + " x 3 values, a position for each row of L");
  const std::vector<double> numbers = numbersOf(array, path);
  if (numbers.empty()) return {};  // an empty vector has no data() to map
  return Eigen::Map<const Points>(numbers.data(), array.shape[0], 3);
}

void requireFinite(const std::filesystem::path& path, const Points& positions, const std::vector<PointStatus>& status) {
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    if (status[i] == PointStatus::active && !positions.row(i).allFinite())
      refuse(path, "the position of point " + std::to_string(i) + " is not finite");
}

}  // namespace tufted::io
