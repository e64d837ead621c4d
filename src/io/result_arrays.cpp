#include "io/result_arrays.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

#include "io/errors.h"
#include "io/file_text.h"
#include "io/npy.h"

namespace tufted::io {
namespace {

using RowsOf9 = Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor>;

/// Frames that are read must be orthonormal to within this; frames rounded to float32 are.
constexpr double tolerance = 1e-6;

bool isOrthonormal(const Eigen::RowVector3d& x, const Eigen::RowVector3d& normal) {
  return std::abs(x.norm() - 1) <= tolerance && std::abs(normal.norm() - 1) <= tolerance &&
         std::abs(x.dot(normal)) <= tolerance;
}

/// Reads an array of a given shape, or with `may_be_empty` one without rows.
/// @param content what its rows hold, for the message
std::vector<double> readRows(const std::filesystem::path& path, std::vector<std::int64_t> shape, bool may_be_empty,
                             const std::string& content) {
  const std::string bytes = readBytes(path);
  const NpyHeader array = parseNpyHeader(bytes, bytes.size(), path);
  std::string wanted;
  for (const std::int64_t length : shape) wanted += (wanted.empty() ? "" : " x ") + std::to_string(length);
  if (may_be_empty && !array.shape.empty() && array.shape[0] == 0) shape[0] = 0;
  if (array.shape != shape) refuse(path, "is not an array of " + wanted + " values, " + content);
  return numbersOf(array, std::string_view(bytes).substr(array.bytes), path);
}

}  // namespace

void writeNpy(const OutputPath& to, std::string_view descr, const std::vector<std::int64_t>& shape,
              const void* values) {
  const std::int64_t count = std::accumulate(shape.begin(), shape.end(), std::int64_t{1}, std::multiplies<>());
  OutputFile file(to);
  file.write(npyHeader(descr, shape));
  file.write(values, static_cast<std::size_t>(count * (descr.back() - '0')));  // the bytes of a value end its name
  file.close();
}

RowsOf9 axesOf(const Frames& frames) {
  RowsOf9 axes(frames.normals.rows(), 9);
  for (Eigen::Index i = 0; i < axes.rows(); ++i) {
    const Eigen::RowVector3d normal = frames.normals.row(i), x = frames.tangents.row(i);
    axes.row(i) << x, normal.cross(x), normal;
  }
  return axes;
}

void writeFrames(const OutputPath& to, const Frames& frames) {
  const RowsOf9 axes = axesOf(frames);
  writeNpy(to, "<f8", {axes.rows(), 3, 3}, axes.data());
}

void writeComponentEdges(const OutputPath& to, const std::vector<ComponentEdges>& edges) {
  std::vector<double> numbers;
  for (const auto& [sides, mean, mean_square] : edges)
    numbers.insert(numbers.end(), {static_cast<double>(sides), mean, mean_square});
  writeNpy(to, "<f8", {std::ssize(edges), 3}, numbers.data());
}

std::vector<double> readValues(const std::filesystem::path& path, std::size_t points) {
  return readRows(path, {std::int64_t(points)}, false, "one for each row of L");
}

Frames readFrames(const std::filesystem::path& path, std::size_t points) {
  const auto numbers = readRows(path, {std::int64_t(points), 3, 3}, true, "three axes for each row of L");
  if (numbers.empty()) return {};  // a mesh has no frames, and an empty vector has no data() to map
  const Eigen::Map<const RowsOf9> axes(numbers.data(), std::ssize(numbers) / 9, 9);
  return {axes.rightCols<3>(), axes.leftCols<3>(), Orientation::arbitrary};
}

Points readPositions(const std::filesystem::path& path, std::size_t points) {
  const auto numbers = readRows(path, {std::int64_t(points), 3}, true, "a position for each row of L");
  if (numbers.empty()) return {};
  return Eigen::Map<const Points>(numbers.data(), std::ssize(numbers) / 3, 3);
}

VectorXd readNoise(const std::filesystem::path& path, std::size_t points) {
  const auto numbers = readRows(path, {std::int64_t(points)}, true, "one for each row of L");
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!(numbers[i] >= 0 && std::isfinite(numbers[i])))
      refuse(path, "the noise of point " + std::to_string(i) + " is negative or not finite");
  return Eigen::Map<const VectorXd>(numbers.data(), std::ssize(numbers));
}

std::vector<ComponentEdges> readComponentEdges(const std::filesystem::path& path, std::size_t components) {
  const auto numbers = readRows(path, {std::int64_t(components), 3}, true, "edges for each component of L");
  std::vector<ComponentEdges> edges;
  for (std::size_t k = 0; k < numbers.size(); k += 3) {
    if (!(numbers[k] >= 0 && numbers[k] <= 0x1p53 && numbers[k] == std::floor(numbers[k]) && numbers[k + 1] >= 0 &&
          numbers[k + 2] >= 0))
      refuse(path, "component " + std::to_string(k / 3) + " has a negative number, or no whole number of sides");
    edges.push_back({static_cast<std::int64_t>(numbers[k]), numbers[k + 1], numbers[k + 2]});
  }
  return edges;
}

void requireOrthonormal(const std::filesystem::path& path, const Frames& frames,
                        const std::vector<PointStatus>& status) {
  for (Eigen::Index i = 0; i < frames.normals.rows(); ++i)
    if (status[i] == PointStatus::active && !isOrthonormal(frames.tangents.row(i), frames.normals.row(i)))
      refuse(path, "the frame of point " + std::to_string(i) + " is not orthonormal");
}

void requireFinite(const std::filesystem::path& path, const Points& positions, const std::vector<PointStatus>& status) {
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    if (status[i] == PointStatus::active && !positions.row(i).allFinite())
      refuse(path, "the position of point " + std::to_string(i) + " is not finite");
}

}  // namespace tufted::io
