#include "algorithms/enclosed_volume.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "tufted/errors.h"

namespace tufted {
namespace {

/// If the fans that close the holes of a cloud's triangles have more than this part of their area, the surface counts
/// as open: noise leaves small holes, an open half sphere has one of half its area.
constexpr double most_hole_area = 0.05;

[[noreturn]] void refuseComponent(const std::string& function, int point, const std::string& why) {
  throw InvalidInput(function + ": the component of point " + std::to_string(point) + " " + why);
}

std::vector<Chart> cutCharts(const std::string& function, const Laplacian& laplacian, const TrianglesRef& triangles) {
  std::int64_t cut = 0;
  return findCharts(function.c_str(), laplacian, triangles, &cut);
}

}  // namespace

EnclosedVolume::EnclosedVolume(const std::string& function, const Laplacian& laplacian, const TrianglesRef& triangles,
                               const Eigen::MatrixXd& points)
    : function_(function),
      components_(findComponents(laplacian)),
      weights_(components_.weights(laplacian.M)),
      points_(static_cast<std::size_t>(components_.count)),
      of_(static_cast<std::size_t>(components_.count)),
      charts_(cutCharts(function, laplacian, triangles)) {
  for (const int i : components_.points) points_[components_.of[i]].push_back(i);
  for (const Chart& chart : charts_) of_[components_.of[chart.triangles.front()[0]]].push_back(&chart);
  for (int c = 0; c < components_.count; ++c) {
    const int first = points_[c].front();
    if (of_[c].empty()) refuseComponent(function, first, "has no triangles, must have some to enclose a volume");
    for (const Chart* chart : of_[c]) {
      if (!chart->is_manifold)
        refuseComponent(function, first, "has an edge of more than two triangles, must have none");
      if (!chart->is_orientable) refuseComponent(function, first, "is nonorientable, must have two sides");
      if (!chart->rims.empty() && laplacian.kind == Kind::mesh)
        refuseComponent(function, first, "has a rim, must be closed");
    }
    const Body& body = before_.emplace_back(measure(points, c));
    if (!(body.hole_area <= most_hole_area * body.area)) refuseComponent(function, first, "has a rim, must be closed");
  }
}

EnclosedVolume::Body EnclosedVolume::measure(const Eigen::MatrixXd& x, int component) const {
  const std::vector<int>& points = points_[component];
  const Eigen::RowVector3d origin = x.row(points.front());
  Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
  for (const int i : points) mean += weights_[i] * (x.row(i) - origin);
  Body body{origin + mean, 0, 0, 0, 0};
  double extent = 0;
  for (const int i : points) extent = std::max(extent, (x.row(i) - body.centre).cwiseAbs().maxCoeff());
  if (!(extent > 0)) return body;
  body.exponent = std::ilogb(extent);
  const auto at = [&](int i) -> Eigen::RowVector3d {
    Eigen::RowVector3d p = x.row(i) - body.centre;
    for (double& value : p) value = std::ldexp(value, -body.exponent);
    return p;
  };
  for (const Chart* chart : of_[component]) {
    double sum = 0;
    for (const auto& [i, j, k] : chart->triangles) {
      const Eigen::RowVector3d a = at(i), b = at(j), c = at(k);
      sum += a.dot(b.cross(c));
      body.area += (b - a).cross(c - a).norm() / 2;
    }
    for (const std::vector<int>& rim : chart->rims) {
      Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
      for (const int i : rim) middle += at(i) / static_cast<double>(rim.size());
      for (std::size_t k = 0; k < rim.size(); ++k) {
        const Eigen::RowVector3d a = at(rim[k]), b = at(rim[(k + 1) % rim.size()]);
        sum += middle.dot(b.cross(a));  // against the direction of the triangle beside it
        body.hole_area += (a - middle).cross(b - middle).norm() / 2;
      }
    }
    body.volume += std::abs(sum) / 6;
  }
  return body;
}

void EnclosedVolume::restore(Eigen::MatrixXd& x) const {
  for (int c = 0; c < components_.count; ++c) {
    const Body old = before_[c], now = measure(x, c);
    for (const auto& [body, when] : {std::pair(old, "before"), std::pair(now, "after")})
      if (!(body.volume > 0))
        refuseComponent(function_, points_[c].front(), std::string("encloses no volume ") + when + " smoothing");
    const double factor = std::ldexp(std::cbrt(old.volume / now.volume), old.exponent - now.exponent);
    for (const int i : points_[c]) x.row(i) = now.centre + factor * (x.row(i) - now.centre);
  }
}

}  // namespace tufted
