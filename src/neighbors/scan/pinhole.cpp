#include "neighbors/scan/pinhole.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "base/buffer.h"
#include "neighbors/scan/sparse_share.h"
#include "tufted/scan_structure.h"

namespace tufted {
namespace {

/// Number of sampled pixels that a camera is fitted to.
constexpr std::int64_t sampled_pixels = 2000;
/// Least number of rows, and of columns, of an image.
constexpr int least_image_side = 8;
/// Least number of samples for the 8 unknowns of a camera.
constexpr int least_samples = 100;
/// The median error of a camera is at most this, in pixels, as that of the depth images of PCL is.
constexpr double usual_error = 0.5;
/// Most samples have at most this error, in pixels: lenses and rounding cause no more.
constexpr double most_error = 2;
/// Least share of the samples with at most `most_error`, and of those in front of the camera.
constexpr double most_share = 0.95;

Buffer<Sighting> takeSightings(const Points& points, int width, int height, const Eigen::Vector3d& origin) {
  Buffer<Sighting> sightings;
  // odd, so that not all samples are in one column
  const std::int64_t stride = std::max<std::int64_t>(1, points.rows() / sampled_pixels) | 1;
  for (std::int64_t i = 0; i < points.rows(); i += stride) {
    const Eigen::Vector3d ray = points.row(i).transpose() - origin;
    if (!ray.allFinite() || ray.isZero(0)) continue;
    const std::int64_t above = i / width;
    const auto column = static_cast<double>(i % width), row = static_cast<double>(above);
    sightings.push_back({{2 * column / (width - 1) - 1, 2 * row / (height - 1) - 1}, ray.stableNormalized()});
  }
  return sightings;
}

/// The camera matrix with (x, y, 1) ~ camera * ray, by linear least squares.
Eigen::Matrix3d fitCamera(std::span<const Sighting> sightings) {
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (const Sighting& sighting : sightings) {
    for (int axis = 0; axis < 2; ++axis) {
      Eigen::Matrix<double, 9, 1> equation = Eigen::Matrix<double, 9, 1>::Zero();
      equation.segment<3>(3 * axis) = -sighting.ray;
      equation.tail<3>() = sighting.pixel[axis] * sighting.ray;
      normal.selfadjointView<Eigen::Lower>().rankUpdate(equation);
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
  const Eigen::Matrix<double, 9, 1> rows = solver.eigenvectors().col(0);
  Eigen::Matrix3d camera;
  camera << rows.head<3>().transpose(), rows.segment<3>(3).transpose(), rows.tail<3>().transpose();
  return camera;
}

}  // namespace

std::optional<Eigen::Vector3d> opticalAxis(std::span<const Sighting> sightings, int width, int height) {
  if (width < least_image_side || height < least_image_side || std::ssize(sightings) < least_samples)
    return std::nullopt;
  const Eigen::Matrix3d camera = fitCamera(sightings);
  Buffer<double> errors;
  errors.reserve(sightings.size());
  std::int64_t before = 0;  // points in front of the camera if its matrix has the right sign
  for (const Sighting& sighting : sightings) {
    const Eigen::Vector3d seen = camera * sighting.ray;
    before += seen.z() > 0 ? 1 : 0;
    const Eigen::Vector2d error = seen.head<2>() / seen.z() - sighting.pixel;
    const double pixels = std::max(std::abs(error.x()) * (width - 1), std::abs(error.y()) * (height - 1)) / 2;
    errors.push_back(std::isfinite(pixels) ? pixels : HUGE_VAL);
  }
  const std::int64_t behind = std::ssize(errors) - before, on_one_side = std::max(before, behind);
  std::sort(errors.begin(), errors.end());
  const auto errorOf = [&](double share) {
    return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
  };
  const bool sees_all = static_cast<double>(on_one_side) >= most_share * static_cast<double>(errors.size()) &&
                        errorOf(0.5) <= usual_error && errorOf(most_share) <= most_error;
  if (!sees_all) return std::nullopt;
  return camera.row(2).transpose().normalized() * (before > behind ? 1 : -1);
}

double sparseShare(const Points& points, int width, int height, const Eigen::Vector3d& origin) {
  if (width < 1 || height < 1 || points.rows() != static_cast<Eigen::Index>(width) * height) return 0;
  const auto isHeld = [&](std::int64_t i) {
    const Eigen::Vector3d ray = points.row(i).transpose() - origin;
    return ray.allFinite() && !ray.isZero(0);
  };
  Buffer<std::uint8_t> row_holds(static_cast<std::size_t>(height), 0), column_holds(static_cast<std::size_t>(width), 0);
  Buffer<std::uint8_t> held(static_cast<std::size_t>(points.rows()), 0);
  for (std::int64_t i = 0; i < points.rows(); ++i)
    if (isHeld(i)) held[i] = row_holds[i / width] = column_holds[i % width] = 1;
  const auto linesOf = [](const Buffer<std::uint8_t>& holds) {
    PixelLines lines;
    for (std::int64_t line = 0; line < std::ssize(holds); ++line)
      if (holds[line] != 0) lines.push_back(line);
    return lines;
  };
  const PixelLines rows = linesOf(row_holds), columns = linesOf(column_holds);
  return sparseShare(rows, columns,
                     [&](int row, int column) { return held[rows[row] * width + columns[column]] != 0; });
}

bool isDepthImage(const Points& points, int width, int height, const Eigen::Vector3d& origin) {
  if (width < least_image_side || height < least_image_side ||
      points.rows() != static_cast<Eigen::Index>(width) * height || !origin.allFinite())
    return false;
  return opticalAxis(takeSightings(points, width, height, origin), width, height).has_value() &&
         sparseShare(points, width, height, origin) <= most_sparse;
}

}  // namespace tufted
