#include "bench/depth_views.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shapes/random.h"
#include "shapes/shapes.h"

namespace tufted::bench {
namespace {

constexpr double disparity = 43.1;  // disparity times depth, pixels times metres: focal length 575, baseline 7.5 cm

/// A plane through `place` with the normal `axis`, a ball around it, or a cylinder around the axis through it.
struct Body {
  enum class Kind { plane, ball, cylinder } kind;
  Eigen::Vector3d place, axis;
  double radius = 0;

  /// Distance along the ray to the body, and the normal there; `nothing` if they do not meet.
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

/// What is seen along a ray.
struct Seen {
  double depth = nothing;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  int body = -1;

  /// The area of surface that a pixel sees along this ray.
  double area(const Eigen::Vector3d& ray, double focal) const {
    return depth * depth / (focal * focal) / std::abs(normal.dot(ray));
  }
};

Seen seenAlong(const Eigen::Vector3d& ray, const std::vector<Body>& bodies) {
  Seen seen;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto [t, normal] = bodies[b].meet(ray);
    if (t > 1e-6 && !(t >= seen.depth)) seen = {t, normal, static_cast<int>(b)};
  }
  return seen;
}

/// The share of a pixel between the middles of the outer pixels, where triangles end.
double shareOf(const View& view, int i) {
  const int row = i / view.width, column = i % view.width;
  return (row == 0 || row == view.height - 1 ? 0.5 : 1) * (column == 0 || column == view.width - 1 ? 0.5 : 1);
}

/// Whether a pixel touches one of another body.
bool isAtEdge(const View& view, int i) {
  const int row = i / view.width, column = i % view.width;
  for (int r = std::max(0, row - 1); r <= std::min(view.height - 1, row + 1); ++r)
    for (int c = std::max(0, column - 1); c <= std::min(view.width - 1, column + 1); ++c)
      if (view.bodies[r * view.width + c] != view.bodies[i]) return true;
  return false;
}

View viewOf(std::uint64_t seed, const std::string& name, const std::vector<Body>& bodies) {
  constexpr int parts = 32;  // rays per pixel in each direction at edges, where surfaces are seen at grazing angles
  shapes::Random random(seed);
  const double aside = random.uniform() - 0.5, above = random.uniform() - 0.5;  // pixels
  View view{.name = name, .points = {}, .normals = {}, .bodies = {}, .areas = {}};
  view.body_count = static_cast<int>(bodies.size());
  view.areas.resize(bodies.size() * view.patches());
  const int n = view.width * view.height;
  view.points.setConstant(n, 3, nothing);
  view.normals.setZero(n, 3);
  view.bodies.assign(static_cast<std::size_t>(n), -1);
  const auto rayOf = [&](int i, double right, double down) {
    return Eigen::Vector3d((i % view.width - (view.width - 1) / 2.0 + aside + right) / view.focal,
                           (i / view.width - (view.height - 1) / 2.0 + above + down) / view.focal, 1);
  };
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d ray = rayOf(i, 0, 0);
    const Seen seen = seenAlong(ray, bodies);
    if (seen.body < 0) continue;
    view.points.row(i) = (seen.depth * ray).transpose();
    view.normals.row(i) = seen.normal.transpose();
    view.bodies[i] = seen.body;
  }
  for (int i = 0; i < n; ++i) {
    const int each = isAtEdge(view, i) ? parts : 1;
    for (int part = 0; part < each * each; ++part) {
      const Eigen::Vector3d ray = rayOf(i, (part % each + 0.5) / each - 0.5, (part / each + 0.5) / each - 0.5);
      const Seen seen = seenAlong(ray, bodies);
      if (seen.body < 0) continue;
      view.areas[view.areaOf(i, seen.body)] += shareOf(view, i) * seen.area(ray, view.focal) / (each * each);
    }
  }
  return view;
}

View roomView() {
  const shapes::Cloud cloud = shapes::depthCamera({.depth_step = 0, .max_depth = 100, .dropouts = 0});
  View view{"room", 525, cloud.width, cloud.height, cloud.points, cloud.normals, cloud.labels, 0, {}};
  view.body_count = 1 + *std::max_element(cloud.labels.begin(), cloud.labels.end());
  view.areas.resize(static_cast<std::size_t>(view.body_count) * view.patches());
  for (int i = 0; i < cloud.points.rows(); ++i) {
    const Eigen::Vector3d point = cloud.points.row(i);
    const Seen seen{point.z(), cloud.normals.row(i), 0};
    if (!std::isfinite(point.z())) continue;
    view.areas[view.areaOf(i, cloud.labels[i])] += shareOf(view, i) * seen.area(point / point.z(), view.focal);
  }
  return view;
}

Body wall(double depth, const Eigen::Vector3d& normal) {
  return {Body::Kind::plane, {0, 0, depth}, normal.normalized()};
}

}  // namespace

bool isInside(const View& view, int pixel, int pixels) {
  const int row = pixel / view.width, column = pixel % view.width;
  if (std::min(row, column) < pixels || row >= view.height - pixels || column >= view.width - pixels) return false;
  for (int r = row - pixels; r <= row + pixels; ++r)
    for (int c = column - pixels; c <= column + pixels; ++c)
      if (view.bodies[r * view.width + c] != view.bodies[pixel]) return false;
  return view.bodies[pixel] >= 0;
}

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return nothing;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

View ballView(std::uint64_t seed) {
  return viewOf(seed, "ball, 1.2 m", {{Body::Kind::ball, {0, 0, ball_depth}, Eigen::Vector3d::Zero(), ball_radius}});
}

View nearView(std::uint64_t seed) {
  using enum Body::Kind;
  return viewOf(seed, "near: mug, ball, pole, table, wall",
                {{cylinder, {0, 0, 0.6}, Eigen::Vector3d::UnitY(), mug_radius},
                 {ball, {0.12, 0.02, 0.65}, Eigen::Vector3d::Zero(), 0.05},
                 {cylinder, {-0.1, 0, 0.7}, Eigen::Vector3d::UnitY(), 0.0018},
                 {plane, {0, 0.12, 0}, Eigen::Vector3d(0, -0.9, -0.3).normalized()},
                 wall(0.9, {0, 0, -1})});
}

std::vector<View> views(std::uint64_t seed) {
  using enum Body::Kind;
  return {roomView(),
          nearView(seed),
          ballView(seed),
          viewOf(seed, "corner, 1.2 m",
                 {{plane, {0, 0.4, 0}, Eigen::Vector3d(0, -0.8, -0.6)}, wall(1.2, {-1, 0, -1}), wall(1.2, {1, 0, -1})}),
          viewOf(seed, "slanted wall, 2.5 m", {wall(2.5, {0.5, -0.3, -0.8})}),
          viewOf(seed, "floor to 6 m", {{plane, {0, 0.8, 0}, Eigen::Vector3d(0, -1, 0)}, wall(6, {0, 0, -1})}),
          viewOf(seed, "wall, 4 m", {wall(4, {0.2, 0.1, -0.97})})};
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
