#include "bench/real_images.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "base/buffer.h"
#include "bench/nearest_points.h"
#include "bench/plane_steps.h"
#include "tufted/denoise.h"
#include "tufted/io/read.h"

namespace tufted::bench {
namespace {

constexpr int widest = 12;       // pixels from the middle of the largest window to its side
constexpr double alike = 0.04;   // pixels are on one surface if their inverse depths differ by less than this share
constexpr double jump = 0.06;    // relative difference of inverse depths above which there is a jump
constexpr int beside_jumps = 5;  // least distance of predicted pixels from jumps, in pixels
constexpr int block = 24;
constexpr double most_error = 12e-3;  // 1 / m; a greater error means another surface, and does not count
constexpr int every = 7;              // one in this many pixels is predicted
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

double inverseAt(const RealImage& image, int pixel) {
  return 1 / image.points(pixel, 2);
}

/// An inverse depth to be predicted, and its place in the image.
struct Target {
  double row, column, inverse;
  int pixel;  ///< index of the nearest pixel
};

/// Whether all pixels near a target are on its surface.
bool isInside(const RealImage& image, const Target& target) {
  for (int i = -beside_jumps; i <= beside_jumps; ++i)
    for (int j = -beside_jumps; j <= beside_jumps; ++j) {
      const double inverse = inverseAt(image, target.pixel + i * image.width + j);
      if (!(std::abs(inverse / target.inverse - 1) <= jump)) return false;
    }
  return true;
}

/// The prediction error of the plane or quadratic fitted to the pixels of a window; NaN if these are too few.
/// @param seen the visible pixels; others are NaN
double errorOf(const RealImage& seen, const Points& moved, const Target& target, int reach, int terms) {
  Eigen::Matrix<double, 6, 6> left = Eigen::Matrix<double, 6, 6>::Identity() * (terms == 3 ? 1 : 0);
  left.topLeftCorner<3, 3>().setZero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  int count = 0;
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      const int pixel = target.pixel + i * seen.width + j;
      if (!(std::abs(inverseAt(seen, pixel) / target.inverse - 1) <= alike)) continue;
      const double u = (pixel / seen.width - target.row) / reach, v = (pixel % seen.width - target.column) / reach;
      Eigen::Matrix<double, 6, 1> base;
      base << 1, u, v, u * u, u * v, v * v;
      if (terms == 3) base.tail<3>().setZero();
      left += base * base.transpose();
      right += base * (1 / moved(pixel, 2) - target.inverse);
      ++count;
    }
  }
  return count < terms + 3 ? no_value : left.ldlt().solve(right)[0];
}

/// The least root mean squared error over all windows.
/// @param side width of the blocks whose mean error is subtracted; 0: nothing is subtracted
double bestOf(const RealImage& seen, const Points& moved, const Buffer<Target>& targets, int side) {
  const int in_row = side > 0 ? seen.width / side + 1 : 1;
  double best = std::numeric_limits<double>::infinity();
  for (const int reach : {1, 2, 3, 5, 8, widest}) {
    for (const int terms : {3, 6}) {
      Buffer<Eigen::Vector3d> blocks(static_cast<std::size_t>(in_row * (side > 0 ? seen.height / side + 1 : 1)),
                                     Eigen::Vector3d::Zero());
      for (const Target& target : targets) {
        const double error = errorOf(seen, moved, target, reach, terms);
        if (!(std::abs(error) <= most_error)) continue;
        const int row = target.pixel / seen.width, column = target.pixel % seen.width;
        blocks[side > 0 ? row / side * in_row + column / side : 0] += Eigen::Vector3d(1, error, error * error);
      }
      double squares = 0, count = 0;
      for (const Eigen::Vector3d& sums : blocks) {
        if (sums[0] < 2) continue;
        squares += sums[2] - (side > 0 ? sums[1] * sums[1] / sums[0] : 0);
        count += sums[0] - (side > 0 ? 1 : 0);
      }
      best = std::min(best, std::sqrt(squares / count));
    }
  }
  return 1000 * best;
}

ImagePrediction predict(const RealImage& seen, const Buffer<Target>& targets, int side) {
  const ScanStructure structure = imageStructure(seen.width, seen.height);
  return {bestOf(seen, seen.points, targets, side), bestOf(seen, denoise(seen.points).positions, targets, side),
          bestOf(seen, denoise(seen.points, {.structure = &structure}).positions, targets, side)};
}

/// A place in an image.
struct Pixel {
  double row, column;

  int nearest(int width) const {
    return static_cast<int>(std::lround(row)) * width + static_cast<int>(std::lround(column));
  }
};

bool isWellInside(const RealImage& image, const Pixel& pixel) {
  return pixel.row > widest && pixel.column > widest && pixel.row < image.height - 1 - widest &&
         pixel.column < image.width - 1 - widest;
}

/// A pinhole camera, u = focal x / z + column and likewise for rows, fitted by least squares to all pixels.
struct Pinhole {
  double focal, row, column;

  Pixel pixelOf(const Eigen::Vector3d& point) const {
    return {focal * point.y() / point.z() + row, focal * point.x() / point.z() + column};
  }
};

Pinhole pinholeOf(const RealImage& image) {
  Eigen::Matrix3d left = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (int i = 0; i < image.points.rows(); ++i) {
    if (!image.points.row(i).allFinite()) continue;
    const Eigen::Vector3d across(image.points(i, 0) / image.points(i, 2), 0, 1);
    const Eigen::Vector3d down(image.points(i, 1) / image.points(i, 2), 1, 0);
    left += across * across.transpose() + down * down.transpose();
    right += across * (i % image.width) + down * (i / image.width);
  }
  const Eigen::Vector3d found = left.ldlt().solve(right);
  return {found[0], found[1], found[2]};
}

/// The plane around a pixel; nullopt if there is none.
std::optional<Frame> planeAt(const RealImage& image, int pixel) {
  std::vector<std::size_t> near;
  for (int i = -widest; i <= widest; i += 4)
    for (int j = -widest; j <= widest; j += 4) {
      const int other = pixel + i * image.width + j;
      if (std::abs(image.points(other, 2) / image.points(pixel, 2) - 1) <= alike)
        near.push_back(static_cast<std::size_t>(other));
    }
  if (near.size() < 30) return std::nullopt;
  return frameOf(rowsOf(image.points, near, static_cast<int>(near.size())));
}

/// Registers a view to another one nearby.
Eigen::Isometry3d registered(const RealImage& image, const RealImage& other, const Pinhole& camera) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (double farthest = 0.3; farthest > 2e-3; farthest *= 0.9) {
    PlaneSteps steps;
    for (int i = 0; i < other.points.rows(); i += 23) {
      const Eigen::Vector3d point = pose * other.points.row(i).transpose();
      const Pixel seen = camera.pixelOf(point);
      if (!isWellInside(image, seen)) continue;
      const std::optional<Frame> plane = planeAt(image, seen.nearest(image.width));
      if (!plane) continue;
      const Eigen::Vector3d normal = plane->axes.col(2);
      const double height = (point - plane->middle.transpose()).dot(normal);
      if (std::abs(height) > std::max(0.02, farthest)) continue;
      steps.add(point, normal, height, std::pow(point.z(), -4));  // the variance of noise grows with z^4
    }
    pose = steps.motion() * pose;
  }
  return pose;
}

}  // namespace

ImagePrediction predictHiddenRows(const RealImage& image) {
  RealImage seen = image;
  Buffer<Target> targets;
  for (int i = 0; i < image.points.rows(); ++i) {
    const int row = i / image.width, column = i % image.width;
    if (row % 2 == 0) continue;
    seen.points.row(i).setConstant(no_value);
    const Target target{static_cast<double>(row), static_cast<double>(column), inverseAt(image, i), i};
    if (i % every == 0 && isWellInside(image, {target.row, target.column}) && isInside(image, target))
      targets.push_back(target);
  }
  return predict(seen, targets, 0);
}

ImagePrediction predictSecondView(const RealImage& image, const RealImage& other) {
  const Pinhole camera = pinholeOf(image);
  const Eigen::Isometry3d pose = registered(image, other, camera);
  Buffer<Target> targets;
  for (int i = 0; i < other.points.rows(); i += every) {
    const Eigen::Vector3d point = pose * other.points.row(i).transpose();
    const Pixel seen = camera.pixelOf(point);
    if (!isWellInside(image, seen)) continue;
    const Target target{seen.row, seen.column, 1 / point.z(), seen.nearest(image.width)};
    if (isInside(image, target)) targets.push_back(target);
  }
  return predict(image, targets, block);
}

RealImage realImage(const std::filesystem::path& path) {
  const Geometry geometry = read(path, ReadAs::cloud);
  return {geometry.points, geometry.width, geometry.height};
}

}  // namespace tufted::bench
