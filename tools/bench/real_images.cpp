#include "bench/real_images.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "base/buffer.h"
#include "tufted/denoise.h"
#include "tufted/io/read.h"

namespace tufted::bench {
namespace {

constexpr int widest = 12;       // pixels from the middle of a window to its side
constexpr double alike = 0.04;   // of the inverse depth: pixels of one surface
constexpr double jump = 0.06;    // of the inverse depth
constexpr int beside_jumps = 5;  // pixels
constexpr int block = 24;
constexpr double most_error = 12e-3;  // 1 / m: more is another surface
constexpr int every = 7;              // of the pixels is predicted
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

double inverseAt(const RealImage& image, int pixel) {
  return 1 / image.points(pixel, 2);
}

/// What is to be predicted: an inverse depth, and where the image shows it.
struct Target {
  double row, column, inverse;
  int pixel;  ///< the nearest one
};

/// Whether all pixels near a target are of its surface.
bool isInside(const RealImage& image, const Target& target) {
  for (int i = -beside_jumps; i <= beside_jumps; ++i)
    for (int j = -beside_jumps; j <= beside_jumps; ++j) {
      const double inverse = inverseAt(image, target.pixel + i * image.width + j);
      if (!(std::abs(inverse / target.inverse - 1) <= jump)) return false;
    }
  return true;
}

/// The error of the plane or the quadratic through the pixels of a window; NaN where there are too few.
/// @param seen the pixels that are, NaN where there is none
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

/// The least over all windows of the root of the mean squared error.
/// @param side of the blocks whose mean error does not count; 0: all counts
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

bool isWellInside(const RealImage& image, double row, double column) {
  return row > widest && column > widest && row < image.height - 1 - widest && column < image.width - 1 - widest;
}

/// u = focal x / z + column, by least squares over all pixels, and the same of the rows.
struct Pinhole {
  double focal, row, column;
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

/// The plane around a pixel; a zero normal where there is none.
struct Plane {
  Eigen::Vector3d middle, normal;
};

Plane planeAt(const RealImage& image, int pixel) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  int count = 0;
  for (int i = -widest; i <= widest; i += 4)
    for (int j = -widest; j <= widest; j += 4) {
      const Eigen::Vector3d point = image.points.row(pixel + i * image.width + j);
      if (!(std::abs(point.z() / image.points(pixel, 2) - 1) <= alike)) continue;
      sum += point;
      squares += point * point.transpose();
      ++count;
    }
  if (count < 30) return {sum, Eigen::Vector3d::Zero()};
  const Eigen::Vector3d middle = sum / count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(squares / count - middle * middle.transpose());
  return {middle, axes.eigenvectors().col(0)};
}

/// Brings a view near another onto it.
Eigen::Isometry3d registered(const RealImage& image, const RealImage& other, const Pinhole& camera) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (double farthest = 0.3; farthest > 2e-3; farthest *= 0.9) {
    Eigen::Matrix<double, 6, 6> left = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
    for (int i = 0; i < other.points.rows(); i += 23) {
      const Eigen::Vector3d point = pose * other.points.row(i).transpose();
      const double column = camera.focal * point.x() / point.z() + camera.column,
                   row = camera.focal * point.y() / point.z() + camera.row;
      if (!isWellInside(image, row, column)) continue;
      const int pixel = static_cast<int>(std::lround(row)) * image.width + static_cast<int>(std::lround(column));
      const Plane plane = planeAt(image, pixel);
      const double height = (point - plane.middle).dot(plane.normal);
      if (plane.normal.isZero() || std::abs(height) > std::max(0.02, farthest)) continue;
      Eigen::Matrix<double, 6, 1> base;
      base << point.cross(plane.normal), plane.normal;
      base /= point.z() * point.z();  // as noise grows
      left += base * base.transpose();
      right -= base * height / (point.z() * point.z());
    }
    const Eigen::Matrix<double, 6, 1> step = left.ldlt().solve(right);
    const double angle = step.head<3>().norm();
    const Eigen::Vector3d axis = angle > 0 ? Eigen::Vector3d(step.head<3>() / angle) : Eigen::Vector3d::UnitX();
    pose = Eigen::Translation3d(step.tail<3>()) * Eigen::AngleAxisd(angle, axis) * pose;
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
    if (i % every == 0 && isWellInside(image, row, column) && isInside(image, target)) targets.push_back(target);
  }
  return predict(seen, targets, 0);
}

ImagePrediction predictSecondView(const RealImage& image, const RealImage& other) {
  const Pinhole camera = pinholeOf(image);
  const Eigen::Isometry3d pose = registered(image, other, camera);
  Buffer<Target> targets;
  for (int i = 0; i < other.points.rows(); i += every) {
    const Eigen::Vector3d point = pose * other.points.row(i).transpose();
    const double column = camera.focal * point.x() / point.z() + camera.column,
                 row = camera.focal * point.y() / point.z() + camera.row;
    if (!isWellInside(image, row, column)) continue;
    const int pixel = static_cast<int>(std::lround(row)) * image.width + static_cast<int>(std::lround(column));
    const Target target{row, column, 1 / point.z(), pixel};
    if (isInside(image, target)) targets.push_back(target);
  }
  return predict(image, targets, block);
}

RealImage realImage(const std::filesystem::path& path) {
  const Geometry geometry = read(path, ReadAs::cloud);
  return {geometry.points, geometry.width, geometry.height};
}

std::vector<ShapeFile> imageFiles(const std::filesystem::path& scans) {
  std::vector<ShapeFile> files = scanFiles(scans);
  std::erase_if(files, [](const ShapeFile& file) {
    const Geometry geometry = read(file.path, ReadAs::cloud);
    return geometry.width != 640 || geometry.height != 480;
  });
  return files;
}

}  // namespace tufted::bench
