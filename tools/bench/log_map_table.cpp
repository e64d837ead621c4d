#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "base/stage_clock.h"
#include "bench/tables.h"
#include "shapes/shapes.h"
#include "tufted/io/read.h"
#include "tufted/tufted.h"

namespace tufted::bench {
namespace {

/// How far lines that are traced by the logarithmic map of some points end from each point, in spacings, ascending.
struct WayBack {
  std::vector<double> errors;
  double seconds = 0;  ///< of the slowest query
};

WayBack wayBack(const Laplacian& laplacian, const Triangles& triangles, const Frames& frames, LogMapMethod method) {
  const LogMapSolver solver(laplacian, frames, {.method = method, .solver = {.threads = 1}});
  const GeodesicTracer tracer(laplacian.positions, triangles, frames);
  const auto n = laplacian.positions.rows();
  const double spacing = std::sqrt(laplacian.M.sum() / static_cast<double>(n));
  constexpr Eigen::Index tried = 600;  // of each source
  WayBack result;
  for (const int source : {3, 77, 500, 1000}) {
    const Stopwatch watch;
    const LogMap map = solver.query(source);
    result.seconds = std::max(result.seconds, watch.seconds());
    for (Eigen::Index i = 0; i < n; i += std::max<Eigen::Index>(1, n / tried)) {
      const double distance = map.coordinates.row(i).norm();
      if (!(distance > 0)) continue;
      const Eigen::RowVector3d direction = map.coordinates(i, 0) * map.first + map.coordinates(i, 1) * map.second;
      const TracedLine traced = tracer.query(SurfacePoint::vertex(source), direction, distance);
      const Eigen::RowVector3d end = traced.line.points.row(traced.line.points.rows() - 1);
      result.errors.push_back((end - laplacian.positions.row(i)).norm() / spacing);
    }
  }
  std::sort(result.errors.begin(), result.errors.end());
  return result;
}

void printWayBack(const std::string& name, const Laplacian& laplacian, const Triangles& triangles,
                  const Frames& frames) {
  std::printf("| %s | %d ", name.c_str(), static_cast<int>(laplacian.positions.rows()));
  for (const LogMapMethod method : {LogMapMethod::exact, LogMapMethod::heat}) {
    const auto [errors, seconds] = wayBack(laplacian, triangles, frames, method);
    const auto at = [&e = errors](double share) { return e[static_cast<std::size_t>(share * (std::ssize(e) - 1))]; };
    const auto far = errors.end() - std::lower_bound(errors.begin(), errors.end(), 0.5);
    std::printf("| %.3f | %.2f | %.1f %% | %.2f s ", at(0.5), at(0.99),
                100.0 * static_cast<double>(far) / static_cast<double>(errors.size()), seconds);
  }
  std::printf("|\n");
  std::fflush(stdout);
}

void printCloud(const std::string& name, const shapes::Cloud& cloud) {
  const Laplacian laplacian = pointCloudLaplacian(cloud.points);
  printWayBack(name, laplacian, surfaceTriangles(laplacian), laplacian.frames);
}

void printMesh(const std::string& name, const Points& points, const Triangles& triangles) {
  printWayBack(name, meshLaplacian(points, triangles), triangles, meshFrames(points, triangles));
}

}  // namespace

void printLogMaps() {
  std::printf(
      "| surface | points | exact: median | 99 %% | at least 0.5 | query | heat: median | 99 %% | at least 0.5 | query "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const int n : {4000, 16000}) printCloud("sphere, cloud", shapes::sphere(n, shapes::Sampling::jittered, 101));
  const shapes::Mesh ball = shapes::icosphere(4);
  printMesh("icosphere", ball.points, ball.triangles);
  for (const int n : {4000, 16000}) printCloud("torus, cloud", shapes::torus(n, shapes::Sampling::jittered, 101));
  for (const char* name : {"spot.obj", "nefertiti.obj"}) {
    const std::filesystem::path file = std::filesystem::path(TUFTED_DATA_DIR).parent_path() / "real/shapes" / name;
    if (!std::filesystem::exists(file)) continue;
    const Geometry mesh = read(file);
    printMesh(name, mesh.points, mesh.triangles);
  }
}

}  // namespace tufted::bench
