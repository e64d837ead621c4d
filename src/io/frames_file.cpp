#include "io/frames_file.h"

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "io/errors.h"
#include "io/file_text.h"
#include "io/npy.h"

namespace tufted::io {
namespace {

/// Frames that are read must be orthonormal to within this; frames rounded to float32 are.
constexpr double tolerance = 1e-6;

bool isOrthonormal(const Eigen::RowVector3d& x, const Eigen::RowVector3d& normal) {
  return std::abs(x.norm() - 1) <= tolerance && std::abs(normal.norm() - 1) <= tolerance &&
         std::abs(x.dot(normal)) <= tolerance;
}

}  // namespace

Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor> axesOf(const Frames& frames) {
  Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor> axes(frames.normals.rows(), 9);
  for (Eigen::Index i = 0; i < axes.rows(); ++i) {
    const Eigen::RowVector3d normal = frames.normals.row(i), x = frames.tangents.row(i);
    axes.row(i) << x, normal.cross(x), normal;
  }
  return axes;
}

void writeFrames(const OutputPath& to, const Frames& frames) {
  const auto axes = axesOf(frames);
  OutputFile file(to);
  file.write(npyHeader("<f8", {axes.rows(), 3, 3}));
  file.write(axes.data(), static_cast<std::size_t>(axes.size()) * sizeof(double));
  file.close();
}

Frames readFrames(const std::filesystem::path& path, std::size_t points) {
  const std::string bytes = readBytes(path);
  const NpyArray array = parseNpy(bytes, path);
  const auto n = static_cast<std::int64_t>(points);
  const bool fits = array.shape.size() == 3 && array.shape[1] == 3 && array.shape[2] == 3;
  if (!fits || (array.shape[0] != n && array.shape[0] != 0))
    refuse(path, "is not an array of " + std::to_string(n) + " x 3 x 3 values, three axes for each row of L");
  const std::vector<double> numbers = numbersOf(array, path);
  if (numbers.empty()) return {};  // a mesh has no frames, and an empty vector has no data() to map
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor>> axes(numbers.data(), array.shape[0],
                                                                                         9);
  return {axes.rightCols<3>(), axes.leftCols<3>(), Orientation::arbitrary};
}

void requireOrthonormal(const std::filesystem::path& path, const Frames& frames,
                        const std::vector<PointStatus>& status) {
  for (Eigen::Index i = 0; i < frames.normals.rows(); ++i)
    if (status[i] == PointStatus::active && !isOrthonormal(frames.tangents.row(i), frames.normals.row(i)))
      refuse(path, "the frame of point " + std::to_string(i) + " is not orthonormal");
}

}  // namespace tufted::io
