#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/stage_clock.h"
#include "bench/tables.h"
#include "shapes/shapes.h"
#include "shapes/slices.h"
#include "tufted/io/read.h"
#include "tufted/tufted.h"

namespace tufted::bench {
namespace {

struct Deviation {
  double mean = 0, greatest = 0;  ///< in root mean square edges
  int wrong_signs = 0;
};

Deviation deviationOf(const VectorXd& found, const VectorXd& exact, double edge) {
  Deviation deviation;
  int count = 0;
  for (Eigen::Index i = 0; i < found.size(); ++i) {
    if (std::isnan(found[i]) || !std::isfinite(exact[i])) continue;
    const double error = std::abs(found[i] - exact[i]) / edge;
    deviation.mean += error;
    deviation.greatest = std::max(deviation.greatest, error);
    deviation.wrong_signs += found[i] * exact[i] < 0 ? 1 : 0;
    ++count;
  }
  deviation.mean /= count;
  return deviation;
}

/// Prints the deviations of both methods from exact distances, whose slices are the curves.
void printExact(const std::string& name, const shapes::Mesh& mesh,
                const std::function<double(const Eigen::RowVector3d&)>& distance) {
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  const Frames frames = meshFrames(mesh.points, mesh.triangles);
  VectorXd exact(mesh.points.rows());
  for (Eigen::Index i = 0; i < exact.size(); ++i) exact[i] = distance(mesh.points.row(i));
  const std::vector<SurfaceCurve> curves = shapes::slices(mesh.points, mesh.triangles, exact);
  std::printf("| %s | %d ", name.c_str(), static_cast<int>(exact.size()));
  for (const DistanceMethod method : {DistanceMethod::marching, DistanceMethod::heat}) {
    const VectorXd found = SignedDistanceSolver(laplacian, frames, {.method = method}).queryAt(curves);
    const Deviation deviation = deviationOf(found, exact, std::sqrt(laplacian.report.mean_squared_edge));
    std::printf("| %.3f | %.2f | %d ", deviation.mean, deviation.greatest, deviation.wrong_signs);
  }
  std::printf("|\n");
}

double fromAxis(const Eigen::RowVector3d& p, double angle) {
  return angle - std::acos(std::clamp(p.dot(Eigen::RowVector3d(0.3, 0.5, 0.8).normalized()), -1.0, 1.0));
}

double fromCircle(const Eigen::RowVector3d& p, double radius) {
  return radius - std::hypot(p.x() - 0.5, p.y() - 0.5);
}

/// Prints by how much the magnitude of both methods differs from DistanceSolver's from the places of the curve.
void printReal(const char* name) {
  const std::filesystem::path file = std::filesystem::path(TUFTED_DATA_DIR).parent_path() / "real/shapes" / name;
  if (!std::filesystem::exists(file)) return;
  const Geometry mesh = read(file);
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  const Frames frames = meshFrames(mesh.points, mesh.triangles);
  const Eigen::VectorXd height = mesh.points.col(1);
  std::vector<SurfaceCurve> curves =
      shapes::slices(mesh.points, mesh.triangles, height.array() - (height.minCoeff() + height.maxCoeff()) / 2);
  const auto longest =
      std::max_element(curves.begin(), curves.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  const SurfaceCurve closed = *longest, open(closed.begin(), closed.begin() + std::ssize(closed) / 3);
  const SolverOptions one_thread = {.threads = 1};
  const DistanceSolver plain(laplacian, {.solver = one_thread});
  for (const auto& [kind, curve] : {std::pair{"closed", closed}, std::pair{"open", open}}) {
    const VectorXd distance = plain.queryAt(curve);
    std::printf("| %s, %s curve of %d places ", name, kind, static_cast<int>(curve.size()));
    for (const DistanceMethod method : {DistanceMethod::marching, DistanceMethod::heat}) {
      const SignedDistanceSolver solver(laplacian, frames, {.method = method, .solver = one_thread});
      const Stopwatch watch;
      const VectorXd found = solver.queryAt({curve});
      const double seconds = watch.seconds();
      const Deviation deviation =
          deviationOf(found.cwiseAbs(), distance, std::sqrt(laplacian.report.mean_squared_edge));
      std::printf("| %.3f | %.2f | %.2f + %.2f s ", deviation.mean, deviation.greatest, solver.report().seconds,
                  seconds);
    }
    std::printf("|\n");
    std::fflush(stdout);
  }
}

}  // namespace

void printSigned() {
  std::printf(
      "| signed distance | vertices | marching, mean | max | wrong signs | heat, mean | max | wrong signs |\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (const int level : {4, 5}) {
    const shapes::Mesh sphere = shapes::icosphere(level), square = shapes::gridSquare(level == 4 ? 50 : 100);
    printExact("sphere, great circle", sphere, [](const auto& p) { return fromAxis(p, M_PI / 2); });
    printExact("sphere, circle of 36 degrees", sphere, [](const auto& p) { return fromAxis(p, M_PI / 5); });
    printExact("square, circle", square, [](const auto& p) { return fromCircle(p, 0.3); });
    printExact("square, two circles around a ring", square,
               [](const auto& p) { return std::min(fromCircle(p, 0.42), -fromCircle(p, 0.17)); });
  }
  std::printf(
      "\n| real shape, distance without sign beside `DistanceSolver` | marching, mean | max | set-up + query | heat, "
      "mean | max | set-up + query |\n|---|---|---|---|---|---|---|\n");
  for (const char* name : {"spot.obj", "elephant.obj", "nefertiti.obj"}) printReal(name);
}

}  // namespace tufted::bench
