#include <algorithm>
#include <memory>
#include <numeric>
#include <string>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "base/power_of_two.h"
#include "base/require.h"
#include "base/scaling.h"
#include "base/stage_clock.h"
#include "cover/cover.h"
#include "neighbors/morton.h"
#include "pipeline/build.h"
#include "pipeline/from_cover.h"
#include "pipeline/result.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* mesh_laplacian_name = "meshLaplacian";

/// Indices of the usable triangles; counts the others.
Buffer<int> usableTriangles(const TrianglesRef& triangles, const std::vector<PointStatus>& status,
                            const std::vector<int>& representative, Report& report) {
  Buffer<int> usable;
  usable.reserve(static_cast<std::size_t>(triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (const int v : triangles.row(t)) {
      if (v < 0 || v >= std::ssize(status)) {
        throw InvalidInput(std::string(mesh_laplacian_name) + ": triangle " + std::to_string(t) + " names vertex " +
                           std::to_string(v) + ", must lie in [0, " + std::to_string(status.size()) + ")");
      }
    }
    const int i = representative[triangles(t, 0)], j = representative[triangles(t, 1)],
              k = representative[triangles(t, 2)];
    const auto isOdd = [&](int v) { return status[v] == PointStatus::not_finite; };
    if (i == j || j == k || k == i) {
      ++report.repeated_vertex_triangles;
    } else if (isOdd(i) || isOdd(j) || isOdd(k)) {
      ++report.not_finite_triangles;
    } else {
      usable.push_back(static_cast<int>(t));
    }
  }
  return usable;
}

}  // namespace

Laplacian meshLaplacian(const PointsRef& points, const TrianglesRef& triangles, const MeshOptions& options) {
  Laplacian result;
  buildMeshLaplacian(points, triangles, options, result);
  return result;
}

void buildMeshLaplacian(const PointsRef& points, const TrianglesRef& triangles, const MeshOptions& options,
                        Laplacian& result) {
  checkBuild(mesh_laplacian_name, options.mollify, options.threads);
  requireAtMost(INT32_MAX, points.rows(), mesh_laplacian_name, "points");
  requireAtMost(most_triangles, triangles.rows(), mesh_laplacian_name, "triangles");
  const Workers workers(options.threads, options.progress);
  restart(result, Kind::mesh, points.rows(), workers);
  Report& report = result.report;
  StageClock clock(report);
  const int n = static_cast<int>(points.rows());

  const Scaling scaling = measureScaling(points, result.status, workers);
  const PowerOfTwo to_scaled = scaling.toScaled();
  PointBuffer scaled(n);
  for (int i = 0; i < n; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      // no -0, so that equal numbers have equal bits
      scaled.row(i)[axis] = to_scaled.times(points(i, axis)) + 0.0;
  }
  if (options.weld) {
    rankPoints(points, result.status, result.representative, workers);
  } else {
    result.representative.resize(n);
    std::iota(result.representative.begin(), result.representative.end(), 0);
  }
  result.boundary.assign(n, Boundary::none);
  result.frames = {};
  result.positions = points;
  result.noise.resize(0);
  const Buffer<int> usable = usableTriangles(triangles, result.status, result.representative, report);
  clock.finish("scale", static_cast<std::size_t>(n) * 3 * sizeof(double) + bytesOf(usable));

  std::shared_ptr<StoredCover> stored = takeCover(result);
  IntrinsicTriangulation& cover = stored->triangulation;
  resizeCover(cover, n, static_cast<std::int64_t>(usable.size()));
  for (std::size_t t = 0; t < usable.size(); ++t) {
    const auto corner = [&](int k) { return result.representative[triangles(usable[t], k)]; };
    addTriangle(cover, static_cast<int>(t), corner(0), corner(1), corner(2));
  }
  const EdgeCounts edges =
      glueEdges(cover, scaled, {options.paper.order, options.paper.seed}, workers, &result.boundary);
  report.boundary_edges = edges.boundary;
  report.nonmanifold_edges = edges.nonmanifold;
  clock.finish("cover", bytesOfCover(cover));

  Buffer<int> input_index(n);
  std::iota(input_index.begin(), input_index.end(), 0);
  finishFromCover(std::move(stored), {scaled, input_index, scaling.exponent}, options.mollify, options.keep_cover,
                  workers, clock, result);
  workers.report("done", 1);
}

}  // namespace tufted
