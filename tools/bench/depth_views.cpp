#include "bench/depth_views.h"

#include <cmath>
#include <limits>
#include <utility>

#include "shapes/random.h"
#include "shapes/shapes.h"

namespace tufted::bench {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double disparity = 43.1;  // pixels times metres: 575 pixels of focal length, 7.5 cm between the lenses

/// A plane through `place` with a normal, a ball around it, or a cylinder around the axis through it.
struct Body {
  enum class Kind { plane, ball, cylinder } kind;
  Eigen::Vector3d place, axis;
  double radius = 0;

  /// Distance along the ray, and the normal there; nothing where they do not meet.
  std::pair<double, Eigen::Vector3d> meet(const Eigen::Vector3d& ray) const {
    if (kind == Kind::plane) return {place.dot(axis) / ray.dot(axis), axis};
    Eigen::Vector3d from = -place, along = ray;
    if (kind == Kind::cylinder) {
      from -= from.dot(axis) * axis;
      along -= along.dot(axis) * axis;
    }
    const double a = along.squaredNorm(), b = from.dot(along), c = from.squaredNorm() - radius * radius;
    const double t = b * b > a * c ? (-b - std::sqrt(b * b - a * c)) / a : nothing;
    return {t, (from + t * along) / radius};
  }
};

View viewOf(const std::string& name, const std::vector<Body>& bodies) {
  View view{.name = name, .points = {}, .normals = {}, .bodies = {}};
  const int n = view.width * view.height;
  view.points.setConstant(n, 3, nothing);
  view.normals.setZero(n, 3);
  view.bodies.assign(static_cast<std::size_t>(n), -1);
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d ray((i % view.width - (view.width - 1) / 2.0) / view.focal,
                              (i / view.width - (view.height - 1) / 2.0) / view.focal, 1);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const auto [t, normal] = bodies[b].meet(ray);
      if (!(t > 1e-6 && t < nearest)) continue;
      nearest = t;
      view.points.row(i) = (t * ray).transpose();
      view.normals.row(i) = normal.transpose();
      view.bodies[i] = static_cast<int>(b);
    }
  }
  return view;
}

View roomView() {
  const shapes::Cloud cloud = shapes::depthCamera({.depth_step = 0, .max_depth = 100, .dropouts = 0});
  return {"room", 525, cloud.width, cloud.height, cloud.points, cloud.normals, cloud.labels};
}

}  // namespace

View ballView() {
  return viewOf("ball, 1.2 m", {{Body::Kind::ball, {0, 0, ball_depth}, Eigen::Vector3d::Zero(), ball_radius}});
}

std::vector<View> views() {
  using enum Body::Kind;
  const auto wall = [](double depth, const Eigen::Vector3d& normal) {
    return Body{plane, {0, 0, depth}, normal.normalized()};
  };
  return {
      roomView(),
      viewOf("near: mug, ball, pole, table, wall", {{cylinder, {0, 0, 0.6}, Eigen::Vector3d::UnitY(), 0.04},
                                                    {ball, {0.12, 0.02, 0.65}, Eigen::Vector3d::Zero(), 0.05},
                                                    {cylinder, {-0.1, 0, 0.7}, Eigen::Vector3d::UnitY(), 0.0018},
                                                    {plane, {0, 0.12, 0}, Eigen::Vector3d(0, -0.9, -0.3).normalized()},
                                                    wall(0.9, {0, 0, -1})}),
      ballView(),
      viewOf("corner, 1.2 m",
             {{plane, {0, 0.4, 0}, Eigen::Vector3d(0, -0.8, -0.6)}, wall(1.2, {-1, 0, -1}), wall(1.2, {1, 0, -1})}),
      viewOf("slanted wall, 2.5 m", {wall(2.5, {0.5, -0.3, -0.8})}),
      viewOf("floor to 6 m", {{plane, {0, 0.8, 0}, Eigen::Vector3d(0, -1, 0)}, wall(6, {0, 0, -1})}),
      viewOf("wall, 4 m", {wall(4, {0.2, 0.1, -0.97})})};
}

Points seenBy(const View& view, const CameraNoise& noise, std::uint64_t seed) {
  shapes::Random random(seed);
  Points points = view.points;
  const double first = noise.step > 0 && noise.sigma == 0 ? noise.step * random.uniform() : 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double z = points(i, 2);
    if (!std::isfinite(z)) continue;
    if (noise.of_range > 0) {
      points.row(i) *= 1 + noise.of_range * random.normal() / points.row(i).norm();
      continue;
    }
    double measured = disparity / z + noise.sigma * random.normal();
    if (noise.step > 0) measured = std::round((measured - first) / noise.step) * noise.step + first;
    points.row(i) *= measured > 0 ? disparity / measured / z : nothing;
  }
  return points;
}

}  // namespace tufted::bench
