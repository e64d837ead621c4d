#include <CGAL/IO/OFF.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/stage_clock.h"
#include "bench/costs.h"
#include "shapes/shapes.h"
#include "tufted/laplacian.h"

namespace tufted::bench {
namespace {

struct MeshCase {
  bool is_sphere;
  int refinement;  ///< subdivisions of the icosphere, or steps along a side of the grid
  bool is_shuffled;
  int threads;

  int triangles() const { return is_sphere ? 20 << 2 * refinement : 2 * refinement * refinement; }
  std::string name() const {
    return std::string("mesh/") + (is_sphere ? "icosphere" : "grid") + "/" + std::to_string(triangles()) + "/" +
           (is_shuffled ? "shuffled" : "coherent") + "/" + threadsName(threads);
  }
};

struct TriangleMesh {
  Points points;
  Triangles triangles;
};

std::vector<int> randomOrder(Eigen::Index size) {
  std::vector<int> order(static_cast<std::size_t>(size));
  std::iota(order.begin(), order.end(), 0);
  std::mt19937_64 random(1);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

/// The mesh with vertices and triangles in random order, so that every access to memory misses the cache.
TriangleMesh shuffled(const TriangleMesh& mesh) {
  const std::vector<int> vertex = randomOrder(mesh.points.rows()), triangle = randomOrder(mesh.triangles.rows());
  TriangleMesh result{Points(mesh.points.rows(), 3), Triangles(mesh.triangles.rows(), 3)};
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v) result.points.row(vertex[v]) = mesh.points.row(v);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int s = 0; s < 3; ++s) result.triangles(triangle[t], s) = vertex[mesh.triangles(t, s)];
  }
  return result;
}

TriangleMesh makeMesh(const MeshCase& c) {
  shapes::Mesh mesh = c.is_sphere ? shapes::icosphere(c.refinement) : shapes::gridSquare(c.refinement);
  TriangleMesh coherent{std::move(mesh.points), std::move(mesh.triangles)};
  return c.is_shuffled ? shuffled(coherent) : coherent;
}

/// The mesh as the text of an OFF file.
std::string offText(const TriangleMesh& mesh) {
  std::string text =
      "OFF\n" + std::to_string(mesh.points.rows()) + " " + std::to_string(mesh.triangles.rows()) + " 0\n";
  std::array<char, 128> line;
  const auto add = [&](const char* format, const auto&... values) {
    text.append(line.data(), static_cast<std::size_t>(std::snprintf(line.data(), line.size(), format, values...)));
  };
  for (const auto& point : mesh.points.rowwise()) add("%.9g %.9g %.9g\n", point[0], point[1], point[2]);
  for (const auto& face : mesh.triangles.rowwise()) add("3 %d %d %d\n", face[0], face[1], face[2]);
  return text;
}

/// Seconds that CGAL takes to read the mesh from memory, which a user spends before any Laplacian.
double readSeconds(const std::string& text) {
  std::vector<CGAL::Simple_cartesian<double>::Point_3> points;
  std::vector<std::vector<std::size_t>> faces;
  std::istringstream stream(text);
  const CpuStopwatch watch;
  if (!CGAL::IO::read_OFF(stream, points, faces)) throw std::runtime_error("CGAL cannot read the mesh");
  return watch.seconds();
}

/// CPU time and `whole_per_read` on one thread, otherwise wall-clock time.
void runMesh(benchmark::State& state, const MeshCase& c) {
  const TriangleMesh mesh = makeMesh(c);
  const std::string text = c.threads == 1 ? offText(mesh) : "";
  Costs costs(c.triangles());
  for ([[maybe_unused]] auto _ : state) {
    const BuildStopwatch watch(c.threads);
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles, {.threads = c.threads});
    const double seconds = watch.seconds();
    state.SetIterationTime(seconds);
    costs.addBuild(seconds, laplacian.report);
    if (c.threads == 1) costs.addSeconds("read", readSeconds(text));
  }
  costs.publish(state);
  if (c.threads == 1) state.counters["whole_per_read"] = costs.medianSeconds("whole") / costs.medianSeconds("read");
}

}  // namespace

void registerMeshes() {
  for (const auto& [is_sphere, refinement] : {std::pair(true, 6), {false, 224}, {true, 8}, {false, 707}}) {
    for (const bool is_shuffled : {false, true}) {
      for (const int threads : {1, 0}) {
        const MeshCase c{is_sphere, refinement, is_shuffled, threads};
        benchmark::RegisterBenchmark(c.name().c_str(), [c](benchmark::State& state) { runMesh(state, c); })
            ->UseManualTime()
            ->Iterations(iterationsFor(c.triangles()))
            ->Unit(benchmark::kMillisecond);
      }
    }
  }
}

}  // namespace tufted::bench
