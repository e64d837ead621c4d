// Minimal surfaces by repeated harmonic maps (Pinkall and Polthier 1993).
#include "tufted/minimal_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "algorithms/charts.h"
#include "algorithms/coincident.h"
#include "algorithms/shape_frame.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/sort_unique.h"
#include "base/stage_clock.h"
#include "tufted/errors.h"
#include "tufted/interpolation.h"

namespace tufted {
namespace {

constexpr const char* minimal_surface_name = "minimalSurface";

[[noreturn]] void refuseSurface(const std::string& why) {
  throw InvalidInput(std::string(minimal_surface_name) + ": " + why);
}

void checkOptions(const MinimalSurfaceOptions& options) {
  if (!(options.tolerance > 0 && std::isfinite(options.tolerance)))
    refuseSurface("tolerance = " + numberText(options.tolerance) + ", must be finite and above 0");
  if (options.max_iterations < 1)
    refuseSurface("max_iterations = " + std::to_string(options.max_iterations) + ", must be at least 1");
}

Triangles trianglesOf(const Laplacian& laplacian, const TrianglesRef& given) {
  const std::vector<std::array<int, 3>> usable = usableTriangles(minimal_surface_name, laplacian, given);
  if (usable.empty()) refuseSurface("no triangle has three different active points, must be at least one");
  Triangles triangles(std::ssize(usable), 3);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) triangles(t, k) = usable[static_cast<std::size_t>(t)][k];
  return triangles;
}

std::vector<std::uint8_t> namedPoints(const Triangles& triangles, std::size_t n) {
  std::vector<std::uint8_t> named(n, 0);
  for (const int i : triangles.reshaped()) named[i] = 1;
  return named;
}

/// The points on edges of one triangle, ascending.
std::vector<int> rimPoints(const Triangles& triangles) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(static_cast<std::size_t>(triangles.size()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles(t, k), triangles(t, (k + 1) % 3));
      edges.emplace_back(low, high);
    }
  std::sort(edges.begin(), edges.end());
  std::vector<int> points;
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    while (last < edges.size() && edges[last] == edges[first]) ++last;
    if (last - first == 1) points.insert(points.end(), {edges[first].first, edges[first].second});
  }
  return points;
}

std::vector<int> fixedPoints(const Laplacian& laplacian, const std::vector<std::uint8_t>& named,
                             const Triangles& triangles, const std::vector<int>& given) {
  std::vector<int> fixed;
  const int n = static_cast<int>(named.size());
  for (const int point : given) {
    if (point < 0 || point >= n)
      refuseSurface("fixed has " + std::to_string(point) + ", must lie in [0, " + std::to_string(n) + ")");
    const int i = laplacian.representative[point];
    if (named[i] == 0)
      refuseSurface("point " + std::to_string(point) + " of fixed lies on no triangle, must lie on one");
    fixed.push_back(i);
  }
  if (given.empty()) fixed = rimPoints(triangles);
  sortUnique(fixed);
  if (fixed.empty()) refuseSurface("the surface has no rim, so points that stay in place must be given");
  return fixed;
}

double areaOf(const Eigen::MatrixXd& x, const Triangles& triangles) {
  double area = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Eigen::RowVector3d a = x.row(triangles(t, 0)), b = x.row(triangles(t, 1)), c = x.row(triangles(t, 2));
    area += (b - a).cross(c - a).norm() / 2;
  }
  return area;
}

/// One iteration: harmonic positions of the free points.
/// @param iterations done before, for errors
Eigen::MatrixXd harmonicPositions(const Laplacian& laplacian, const std::vector<int>& fixed, const Eigen::MatrixXd& x,
                                  const SolverOptions& options, int iterations) {
  try {
    return harmonic(laplacian, {fixed, x(fixed, Eigen::all)}, options);
  } catch (const SolverFailure& failure) {
    throw SolverFailure(std::string(minimal_surface_name) + ": after " + std::to_string(iterations) +
                        " iterations a part of the surface has nearly no area left, fix more points (" +
                        failure.what() + ")");
  }
}

/// The farthest move of a point off the surface: root mean square, by area, of its moves along the normals of its
/// triangles. Moves within the surface do not count, as they do not change it.
double farthestOff(const Eigen::MatrixXd& x, const Eigen::MatrixXd& next, const Triangles& triangles) {
  VectorXd squares = VectorXd::Zero(x.rows()), areas = VectorXd::Zero(x.rows());
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Eigen::RowVector3d a = x.row(triangles(t, 0)), b = x.row(triangles(t, 1)), c = x.row(triangles(t, 2));
    const Eigen::RowVector3d normal = (b - a).cross(c - a);
    const double area = normal.norm();
    if (!(area > 0)) continue;
    for (const int i : triangles.row(t)) {
      squares[i] += std::pow(normal.dot(next.row(i) - x.row(i)), 2) / area;
      areas[i] += area;
    }
  }
  double farthest = 0;
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    if (areas[i] > 0) farthest = std::max(farthest, std::sqrt(squares[i] / areas[i]));
  return farthest;
}

}  // namespace

Points minimalSurface(const Laplacian& laplacian, const TrianglesRef& given, const MinimalSurfaceOptions& options,
                      MinimalSurfaceReport* report) {
  const Stopwatch watch;
  checkOptions(options);
  const ShapeFrame frame(minimal_surface_name, laplacian);
  const Triangles triangles = trianglesOf(laplacian, given);
  const std::vector<std::uint8_t> named = namedPoints(triangles, laplacian.status.size());
  const std::vector<int> fixed = fixedPoints(laplacian, named, triangles, options.fixed);
  const Workers workers(options.solver.threads, options.solver.progress);

  MinimalSurfaceReport made;
  Eigen::MatrixXd x = frame.toFrame(laplacian.positions);
  made.area_before = frame.areaToCaller(areaOf(x, triangles));
  std::vector<std::uint8_t> is_free = named;
  for (const int i : fixed) is_free[i] = 0;
  made.fixed = std::ssize(fixed);
  std::vector<std::uint8_t> has_moved(named.size(), 0);
  while (made.iterations < options.max_iterations && !made.converged) {
    workers.report("minimal surface", static_cast<double>(made.iterations) / options.max_iterations);
    const Progress within = [&](std::string_view, double) {
      return options.solver.progress == nullptr ||
             options.solver.progress("minimal surface", static_cast<double>(made.iterations) / options.max_iterations);
    };
    const Laplacian now = meshLaplacian(Points(x), triangles,
                                        {.threads = options.solver.threads, .keep_cover = false, .progress = within});
    SolverOptions solver = options.solver;
    solver.progress = within;
    Eigen::MatrixXd next = harmonicPositions(now, fixed, x, solver, made.iterations);
    made.moved = made.floating = 0;
    for (std::size_t i = 0; i < named.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const bool moves = is_free[i] != 0 && next.row(row).allFinite();
      if (is_free[i] != 0) ++(moves ? made.moved : made.floating);
      has_moved[i] |= static_cast<std::uint8_t>(moves);
      if (!moves) next.row(row) = x.row(row);
    }
    const double farthest = farthestOff(x, next, triangles);
    x.swap(next);
    ++made.iterations;
    made.last_move = frame.toCaller(farthest);
    made.converged = farthest <= options.tolerance * frame.extent();
  }
  made.area = frame.areaToCaller(areaOf(x, triangles));
  Eigen::MatrixXd result = laplacian.positions;
  for (std::size_t i = 0; i < named.size(); ++i)
    if (has_moved[i] != 0) result.row(static_cast<Eigen::Index>(i)) = frame.toCaller(Eigen::RowVector3d(x.row(i)));
  copyToCoincident(laplacian, result);
  workers.report("done", 1);
  made.seconds = watch.seconds();
  if (report != nullptr) *report = made;
  return result;
}

}  // namespace tufted
