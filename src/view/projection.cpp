#include "view/projection.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tufted/errors.h"
#include "view/shown_values.h"
#include "view/threads.h"

namespace tufted::view {
namespace {

using Eigen::Vector3d;

/// The points fill this share of the viewport, because discs reach beyond them.
constexpr double fill = 0.93;
/// Most points from which a camera is chosen.
constexpr int most_samples = 100000;
/// Half the vertical angle of view, in radians: that of a lens of about 50 mm, without distortion at the edges.
constexpr double half_angle = 0.31;
/// Points beyond the 1st or the 99th percentile by more than this share of their distance are not fitted into the
/// picture.
constexpr double reach = 0.25;
/// A scene whose least variance is below this share of the middle one is flat, such as a terrain, or a room scanned
/// from one side.
constexpr double flatness = 0.12;
/// A scene whose middle variance is below this share of the greatest one is a line, thinner than a hundredth of its
/// length, and is not viewed along it.
constexpr double slenderness = 1e-4;

struct Box {
  Vector3d low = Vector3d::Zero(), high = Vector3d::Zero();
};

/// The box of most points: as far as they extend, but beyond the percentiles by at most `reach`.
Box robustBox(const Points& positions, const std::vector<int>& numbers) {
  Box box;
  std::vector<double> values(numbers.size());
  for (int k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < numbers.size(); ++i) values[i] = positions(numbers[i], k);
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    const double low = *least;
    const double high = *greatest;
    const double first = percentile(values, 0.01);
    const double last = percentile(values, 0.99);
    box.low[k] = std::max(low, first - reach * (last - first));
    box.high[k] = std::min(high, last + reach * (last - first));
  }
  return box;
}

/// At most `most_samples` of the points, evenly chosen.
std::vector<int> someOf(const std::vector<int>& numbers) {
  const std::size_t step = numbers.size() / most_samples + 1;
  std::vector<int> some;
  for (std::size_t i = 0; i < numbers.size(); i += step) some.push_back(numbers[i]);
  return some;
}

/// The points of `numbers` in their robustBox().
std::vector<int> insideOf(const Points& positions, const std::vector<int>& numbers) {
  if (numbers.empty()) return {};
  const Box box = robustBox(positions, numbers);
  std::vector<int> inside;
  for (const int i : numbers) {
    const Vector3d p = positions.row(i);
    if ((p.array() >= box.low.array()).all() && (p.array() <= box.high.array()).all()) inside.push_back(i);
  }
  return inside.empty() ? numbers : inside;
}

/// Principal axes of points, by ascending variance.
struct Axes {
  Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();
  Vector3d variances = Vector3d::Ones();
};

Axes axesOf(const Points& positions, const std::vector<int>& numbers) {
  if (numbers.size() < 2) return {};
  Vector3d mean = Vector3d::Zero();
  for (const int i : numbers) mean += positions.row(i).transpose();
  mean /= static_cast<double>(numbers.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const int i : numbers) {
    const Vector3d d = positions.row(i).transpose() - mean;
    covariance += d * d.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);  // the general way would take four seconds to compile
  return {solver.eigenvectors(), solver.eigenvalues() / static_cast<double>(numbers.size())};
}

/// The direction with this azimuth around `up` and this elevation, in degrees.
Vector3d directionAt(const Vector3d& up, double azimuth, double elevation) {
  int axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  Vector3d first = Vector3d::Unit((axis + 1) % 3);
  first = (first - first.dot(up) * up).normalized();
  const Vector3d second = up.cross(first);
  const double a = azimuth * std::numbers::pi / 180;
  const double e = elevation * std::numbers::pi / 180;
  return std::cos(e) * (std::cos(a) * first + std::sin(a) * second) + std::sin(e) * up;
}

/// Chooses the directions of the eye and of up, unless they are given, that is, not 0.
void chooseDirections(const NormalizedPoints& points, const std::vector<int>& inside, Vector3d& eye, Vector3d& up) {
  const Axes axes = axesOf(points.positions, inside);
  Vector3d thin = axes.directions.col(0);
  if (eye.norm() == 0 && axes.variances[1] < slenderness * axes.variances[2]) {
    const Vector3d line = axes.directions.col(2);
    if (up.norm() == 0) up = Vector3d::UnitZ();
    const Vector3d across = line.cross(up);
    eye = across.norm() > 0.1 ? across.normalized() : line.unitOrthogonal();
    if (eye.y() > 0) eye = -eye;
    return;
  }
  const bool is_flat = axes.variances[0] < flatness * axes.variances[1];
  const bool is_upright = std::abs(thin.z()) < std::numbers::sqrt2 / 2;
  const bool knows_up = up.norm() > 0;
  // A sensor is usually at the origin of its coordinates.
  const Vector3d to_zero = points.at(Vector3d::Zero());
  if (is_flat && (!is_upright || knows_up)) {  // a terrain or a floor
    if (!knows_up) up = thin.z() < 0 ? Vector3d(-thin) : thin;
    if (eye.norm() == 0) {
      const Vector3d side = axes.directions.col(1);
      const Vector3d level = (side - side.dot(up) * up).normalized();
      eye = (level.y() > 0 ? Vector3d(-level) : level) + 0.9 * up;
    }
    return;
  }
  const bool is_seen_from_zero = to_zero.norm() > 1.2 && to_zero.norm() < 20;
  if (is_flat || (is_seen_from_zero && std::abs(to_zero.normalized().z()) > 0.9)) {  // upright before a sensor
    if (eye.norm() == 0) {
      eye = is_seen_from_zero ? to_zero.normalized() : thin;
      if (!is_seen_from_zero && eye.sum() < 0) eye = -eye;
    }
    if (!knows_up) {
      const Vector3d& e = eye;
      const bool is_along_z = std::abs(e.z()) >= std::max(std::abs(e.x()), std::abs(e.y()));
      // Coordinates of depth cameras have y downwards and z forwards.
      up = is_along_z ? (e.z() < 0 ? Vector3d(-Vector3d::UnitY()) : Vector3d::UnitY()) : Vector3d::UnitZ();
    }
    return;
  }
  if (!knows_up) up = Vector3d::UnitZ();
  if (eye.norm() > 0) return;
  // Views the broad side, from the front right and a little from above.
  Eigen::Vector3d level = Vector3d::Zero();
  for (int k = 0; k < 3 && level.norm() < 0.5; ++k) {
    const Vector3d axis = axes.directions.col(k);
    level = axis - axis.dot(up) * up;
  }
  level.normalize();
  if (level.y() - 0.5 * level.x() > 0) level = -level;
  const Eigen::AngleAxisd aside(0.5, up);
  eye = aside * level + 0.4 * up;
}

/// Moves the target, unless `keeps_target`, and the eye so that the points just fit, with a margin.
void fit(const NormalizedPoints& points, const std::vector<int>& inside, const Viewport& port, bool keeps_target,
         Projection& projection) {
  const double half_width = 0.5 * std::max(port.right - port.left, 1) / projection.focal * fill;
  const double half_height = 0.5 * std::max(port.bottom - port.top, 1) / projection.focal * fill;
  projection.distance = 0;
  for (int round = 0; round < 4; ++round) {
    double distance = 0;
    for (const int i : inside) {
      const Vector3d view = projection.toView(points.positions.row(i).transpose());
      const double toward = projection.distance - view.z();
      distance =
          std::max({distance, toward + std::abs(view.x()) / half_width, toward + std::abs(view.y()) / half_height});
    }
    projection.distance = distance > 0 ? distance : 5;
    if (keeps_target || inside.empty()) return;
    if (round == 3) return;
    Vector3d low(1e9, 1e9, 0);
    Vector3d high = -low;
    for (const int i : inside) {
      const Vector3d view = projection.toView(points.positions.row(i).transpose());
      const Vector3d slope = view / std::max(view.z(), nearest_depth);
      low = low.cwiseMin(slope);
      high = high.cwiseMax(slope);
    }
    const Vector3d middle = 0.5 * projection.distance * (low + high);
    projection.target += middle.x() * projection.right + middle.y() * projection.up;
  }
}

/// Does the same in parallel projection, where the scale decides what fits. The eye is as far above the highest point
/// as in perspective, so that depths shade as much.
void fitParallel(const NormalizedPoints& points, const std::vector<int>& inside, const Viewport& port,
                 bool keeps_target, Projection& projection) {
  projection.is_parallel = true;
  projection.distance = 0;
  Vector3d low = Vector3d::Constant(inside.empty() ? 0 : 1e9);
  Vector3d high = -low;
  for (const int i : inside) {
    const Vector3d view = projection.toView(points.positions.row(i).transpose());
    low = low.cwiseMin(view);
    high = high.cwiseMax(view);
  }
  if (!keeps_target) {
    const Vector3d middle(0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), 0);
    projection.target += middle.x() * projection.right + middle.y() * projection.up;
    low -= middle;
    high -= middle;
  }
  const Vector3d half = high.cwiseMax(-low);
  const double scale = std::min((port.right - port.left) / half.x(), (port.bottom - port.top) / half.y());
  projection.distance = half.z() + 1 / std::tan(half_angle);
  projection.focal = std::isfinite(scale) && scale > 0 ? 0.5 * fill * scale : projection.focal / projection.distance;
}

}  // namespace

Vector3d NormalizedPoints::at(const Vector3d& position) const {
  Vector3d scaled;
  for (int k = 0; k < 3; ++k) scaled[k] = std::ldexp(position[k], -exponent);
  return (scaled - origin) * unit;
}

NormalizedPoints normalize(const Scene& scene, int threads) {
  NormalizedPoints points;
  const Eigen::Index n = scene.positions.rows();
  double greatest = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!scene.positions.row(i).allFinite()) continue;
    points.finite.push_back(static_cast<int>(i));
    greatest = std::max(greatest, scene.positions.row(i).cwiseAbs().maxCoeff());
  }
  points.exponent = greatest > 0 ? std::ilogb(greatest) : 0;
  points.positions = Points::Zero(n, 3);
  const auto convert = [&](const auto& position_of) {
    forBlocks(threads, static_cast<std::int64_t>(points.finite.size()), 8192,
              [&](std::int64_t begin, std::int64_t end) {
                for (std::int64_t k = begin; k < end; ++k) position_of(points.finite[static_cast<std::size_t>(k)]);
              });
  };
  convert([&](int i) {
    for (int k = 0; k < 3; ++k) points.positions(i, k) = std::ldexp(scene.positions(i, k), -points.exponent);
  });
  if (points.finite.empty()) return points;
  const Box box = robustBox(points.positions, someOf(points.finite));
  points.origin = 0.5 * (box.low + box.high);
  const double size = 0.5 * (box.high - box.low).maxCoeff();
  points.unit = size > 0 ? 1 / size : 1;
  convert(
      [&](int i) { points.positions.row(i) = (points.positions.row(i) - points.origin.transpose()) * points.unit; });
  return points;
}

void checkCamera(const Camera& camera, const char* function) {
  const auto refuse = [function](const std::string& what) {
    throw InvalidInput(std::string(function) + ": camera: " + what);
  };
  if (!camera.eye.allFinite()) refuse("eye must be finite");
  if (!camera.up.allFinite()) refuse("up must be finite");
  if (camera.azimuth && !std::isfinite(*camera.azimuth)) refuse("azimuth must be finite");
  if (camera.elevation && !(std::abs(*camera.elevation) <= 90))
    refuse("elevation " + std::to_string(*camera.elevation) + ", must be from -90 to 90");
  if (!(camera.zoom > 0) || !std::isfinite(camera.zoom))
    refuse("zoom " + std::to_string(camera.zoom) + ", must be positive");
  if (camera.viewpoint && !camera.viewpoint->allFinite()) refuse("viewpoint must be finite");
  if (camera.look_at && !camera.look_at->allFinite()) refuse("look_at must be finite");
}

Projection project(const NormalizedPoints& points, const Camera& camera, const Viewport& viewport) {
  const std::vector<int> inside = insideOf(points.positions, someOf(points.finite));
  Projection projection;
  projection.target = camera.look_at ? points.at(*camera.look_at) : Vector3d::Zero();
  Vector3d up = camera.up.stableNormalized();
  Vector3d eye = camera.eye.stableNormalized();
  if (camera.viewpoint) eye = (points.at(*camera.viewpoint) - projection.target).stableNormalized();
  const bool turns = camera.azimuth || camera.elevation;
  if (turns && up.norm() == 0) {
    Vector3d nowhere = Vector3d::UnitX();
    chooseDirections(points, inside, nowhere, up);
    // Azimuth and elevation refer to a coordinate axis.
    int axis = 0;
    up.cwiseAbs().maxCoeff(&axis);
    up = Vector3d::Unit(axis) * (up[axis] < 0 ? -1.0 : 1.0);
  }
  if (turns && !camera.viewpoint) eye = directionAt(up, camera.azimuth.value_or(-60), camera.elevation.value_or(25));
  chooseDirections(points, inside, eye, up);
  projection.back = eye.normalized();
  Vector3d right = up.cross(projection.back);
  if (right.norm() < 1e-6) right = Vector3d::UnitY().cross(projection.back);  // straight from above: y is up
  if (right.norm() < 1e-6) right = Vector3d::UnitX();
  projection.right = right.normalized();
  projection.up = projection.back.cross(projection.right);
  const int port_height = std::max(viewport.bottom - viewport.top, 1);
  projection.focal = 0.5 * port_height / std::tan(half_angle);
  projection.center_x = 0.5 * (viewport.left + viewport.right);
  projection.center_y = 0.5 * (viewport.top + viewport.bottom);
  if (camera.is_parallel) {
    fitParallel(points, inside, viewport, camera.look_at.has_value(), projection);
    projection.focal *= camera.zoom;
  } else if (camera.viewpoint && (camera.look_at || points.finite.empty())) {
    projection.distance = (points.at(*camera.viewpoint) - projection.target).norm();
    if (!(projection.distance > 0)) projection.distance = 1;
  } else if (camera.viewpoint) {
    projection.distance = points.at(*camera.viewpoint).norm();
  } else {
    fit(points, inside, viewport, camera.look_at.has_value(), projection);
    projection.distance /= camera.zoom;
  }
  return projection;
}

}  // namespace tufted::view
