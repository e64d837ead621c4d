#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/stage_clock.h"
#include "bench/real_shapes.h"
#include "bench/tables.h"
#include "oracles/classic_heat.h"
#include "oracles/geodesics.h"
#include "oracles/planar.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/denoise.h"
#include "tufted/distance.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"
#include "tufted/path.h"

namespace tufted::bench {
namespace {

/// Errors of distances where the exact distance is finite; infinite if a distance there is not.
struct Error {
  double mean = 0;      ///< mean |d - exact| over mean exact
  double greatest = 0;  ///< greatest |d - exact| over greatest exact
};

Error errorOf(const VectorXd& distance, const VectorXd& exact) {
  double sum = 0, exact_sum = 0, worst = 0, farthest = 0;
  for (Eigen::Index i = 0; i < exact.size(); ++i) {
    if (!std::isfinite(exact[i])) continue;
    if (!std::isfinite(distance[i])) return {HUGE_VAL, HUGE_VAL};
    const double error = std::abs(distance[i] - exact[i]);
    sum += error, exact_sum += exact[i];
    worst = std::max(worst, error), farthest = std::max(farthest, exact[i]);
  }
  return {sum / exact_sum, worst / farthest};
}

const DistanceOptions by_heat = {.method = DistanceMethod::heat};

/// Sets exact distances of points that take no part to infinity, so that they are left out.
VectorXd whereActive(VectorXd exact, const Laplacian& laplacian) {
  for (Eigen::Index i = 0; i < exact.size(); ++i)
    if (laplacian.status[i] != PointStatus::active) exact[i] = HUGE_VAL;
  return exact;
}

/// Calls visit(file, geometry, exact distances from the first corner of the first triangle) for those of CGAL's meshes
/// on which its exact search works and is fast enough.
template <class Visit>
void forEachMesh(const Visit& visit) {
  for (const auto& file : filesIn({TUFTED_CGAL_DATA_DIR "/meshes"})) {
    Geometry geometry;
    try {
      geometry = read(file);
    } catch (const IoError&) {
      continue;
    }
    if (geometry.triangles.rows() < 100 || geometry.triangles.rows() > 6000) continue;
    if (const auto exact = oracles::exactDistances(geometry.points, geometry.triangles, 0, {1, 0, 0}))
      visit(file, geometry, *exact);
  }
}

/// The exact distance of the first corner of the first triangle from a vertex.
double exactFrom(const Geometry& geometry, int vertex) {
  for (int face = 0; face < geometry.triangles.rows(); ++face) {
    for (int k = 0; k < 3; ++k) {
      if (geometry.triangles(face, k) != vertex) continue;
      std::array<double, 3> corner = {0, 0, 0};
      corner[k] = 1;
      return oracles::exactDistances(geometry.points, geometry.triangles, face, corner)
          .value()[geometry.triangles(0, 0)];
    }
  }
  return HUGE_VAL;
}

/// Numbers of paths, and of those longer than exact ones by more than half a percent and by more than one percent.
struct PathCount {
  int pairs = 0, half = 0, one = 0;
  double least = 0, worst = 0;  ///< least and greatest excess, as a share of the exact length

  void add(double length, double exact) {
    const double share = length / exact - 1;
    ++pairs;
    half += share > 0.005 ? 1 : 0;
    one += share > 0.01 ? 1 : 0;
    least = std::min(least, share), worst = std::max(worst, share);
  }
  void print(const char* name, double milliseconds) const {
    std::printf("| %s | %d | %.2f %% | %.2f %% | %.1e | %.1f %% | %.2f |\n", name, pairs, 100.0 * half / pairs,
                100.0 * one / pairs, least, 100 * worst, milliseconds / pairs);
    std::fflush(stdout);
  }
};

/// Points of a torus, and their exact distances from the first one on a triangulation.
struct Torus {
  Points points;
  VectorXd exact;
};

/// Half of the vertices, chosen by the seed, of a mesh that has a random vertex in each cell of a grid.
Torus torusCloud(int n, std::uint64_t seed) {
  const int along = static_cast<int>(std::sqrt(2 * n / 2.5)), around = 2 * n / along;
  shapes::Random random(seed);
  Points vertices(Eigen::Index{around} * along, 3);
  Triangles triangles(2 * vertices.rows(), 3);
  const auto number = [&](int i, int j) { return (i % around) * along + j % along; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < along; ++j) {
      const double u = 2 * M_PI * (i + 0.6 * random.uniform()) / around,
                   v = 2 * M_PI * (j + 0.6 * random.uniform()) / along;
      const double radius = 1 + 0.4 * std::cos(v);
      const int at = number(i, j);
      vertices.row(at) << radius * std::cos(u), radius * std::sin(u), 0.4 * std::sin(v);
      triangles.row(2 * at) << at, number(i + 1, j), number(i + 1, j + 1);
      triangles.row(2 * at + 1) << at, number(i + 1, j + 1), number(i, j + 1);
    }
  }
  const VectorXd exact = oracles::exactDistances(vertices, triangles, 0, {1, 0, 0}).value();
  std::vector<int> drawn = {0};
  for (int i = 1; i < vertices.rows(); ++i)
    if (random.uniform() < 0.5) drawn.push_back(i);
  return {vertices(drawn, Eigen::all), exact(drawn)};
}

/// Least time of ten runs, because other processes may be running.
double leastTime(const std::function<void()>& work) {
  double least = HUGE_VAL;
  for (int repetition = 0; repetition < 10; ++repetition) {
    const Stopwatch watch;
    work();
    least = std::min(least, 1e3 * watch.seconds());
  }
  return least;
}

}  // namespace

void printMeshes() {
  std::printf(
      "| mesh | triangles | marching, mean | max | heat, mean | max | heat by cotan, mean | max |\n"
      "|---|---|---|---|---|---|---|---|\n");
  std::vector<double> marching, heat, theirs;
  int better = 0;
  forEachMesh([&](const std::filesystem::path& file, const Geometry& geometry, const VectorXd& exact) {
    const int source = geometry.triangles(0, 0);
    const Laplacian laplacian = meshLaplacian(geometry.points, geometry.triangles);
    const Error m = errorOf(DistanceSolver(laplacian).query({source}), exact);
    const Error a = errorOf(DistanceSolver(laplacian, by_heat).query({source}), exact);
    const Error b = errorOf(oracles::classicHeatDistances(geometry.points, geometry.triangles, source), exact);
    const bool has_theirs = std::isfinite(b.mean);  // false if its matrix has no factor
    better += m.mean <= a.mean && m.greatest <= a.greatest ? 1 : 0;
    marching.push_back(m.mean), heat.push_back(a.mean), theirs.push_back(has_theirs ? b.mean : INFINITY);
    std::printf("| %s | %d | %.2f %% | %.1f %% | %.2f %% | %.1f %% | ", file.filename().c_str(),
                static_cast<int>(geometry.triangles.rows()), 100 * m.mean, 100 * m.greatest, 100 * a.mean,
                100 * a.greatest);
    if (has_theirs)
      std::printf("%.2f %% | %.1f %% |\n", 100 * b.mean, 100 * b.greatest);
    else
      std::printf("no factor | |\n");
    std::fflush(stdout);
  });
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
  };
  if (marching.empty()) return;
  std::printf("| median of %zu | | %.2f %% | | %.2f %% | | %.2f %% | |\n", heat.size(), 100 * median(marching),
              100 * median(heat), 100 * median(theirs));
  std::printf("\nMarching is better than heat in mean and greatest error on %d of %zu.\n", better, heat.size());
}

void printPaths() {
  // CGAL's search is inexact: from one end of a pair it may miss the shortest path that it finds from the other.
  constexpr double rounding = 1e-9;
  std::printf(
      "| paths | pairs | longer by 0.5 %% | by 1 %% | least excess | greatest | ms for each |\n"
      "|---|---|---|---|---|---|---|\n");
  constexpr std::uint64_t seed = 101;
  constexpr int targets = 100;
  shapes::Random random(seed);
  const auto drawn = [&random](Eigen::Index n) { return static_cast<int>(random.uniform() * static_cast<double>(n)); };
  PathCount meshes;
  double milliseconds = 0;
  forEachMesh([&](const std::filesystem::path&, const Geometry& geometry, const VectorXd& exact) {
    const Laplacian laplacian = meshLaplacian(geometry.points, geometry.triangles);
    const PathSolver solver(laplacian, {.threads = 1});
    std::vector<std::pair<int, double>> lengths;
    const Stopwatch watch;
    for (int t = 0; t < targets; ++t) {
      const int to = drawn(exact.size());
      if (exact[to] > 0) lengths.emplace_back(to, solver.query(geometry.triangles(0, 0), to).length);
    }
    milliseconds += 1e3 * watch.seconds();
    for (const auto& [to, length] : lengths)
      meshes.add(length, length < (1 - rounding) * exact[to] ? exactFrom(geometry, to) : exact[to]);
  });
  meshes.print("CGAL's meshes", milliseconds);
  for (const int n : {4000, 16000, 64000}) {
    const Points points = shapes::sphere(n, shapes::Sampling::uniform, seed).points;
    const PathSolver solver(pointCloudLaplacian(points), {.threads = 1});
    PathCount clouds;
    const int from = drawn(n);
    const VectorXd exact = shapes::sphereDistances(points, from);
    const Stopwatch watch;
    for (int t = 0; t < targets; ++t) {
      const int to = drawn(n);
      if (exact[to] > 0) clouds.add(solver.query(from, to).length, exact[to]);
    }
    clouds.print(("sphere, " + std::to_string(n) + " points").c_str(), 1e3 * watch.seconds());
  }
}

/// The paper's Figure 16: three pages that meet at a spine, with exact distances by unfolding.
void printNonmanifold() {
  std::printf(
      "| three pages, slivers | vertices | cotan, mean | max | heat, mean | max | marching, mean | max |\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (const double stretch : {1.0, 4.0, 16.0}) {
    const oracles::Book book = oracles::badBook(3, 40, stretch, 1);
    const int source = 41 + 500;  // inside the first page
    const VectorXd exact = oracles::bookDistances(book, source);
    const Error a = errorOf(oracles::classicHeatDistances(book.points, book.triangles, source), exact);
    const Laplacian laplacian = meshLaplacian(book.points, book.triangles);
    const Error b = errorOf(DistanceSolver(laplacian, by_heat).query({source}), exact);
    const Error c = errorOf(DistanceSolver(laplacian).query({source}), exact);
    std::printf("| stretched %g times | %d | %.1f %% | %.1f %% | %.1f %% | %.1f %% | %.2f %% | %.2f %% |\n", stretch,
                static_cast<int>(exact.size()), 100 * a.mean, 100 * a.greatest, 100 * b.mean, 100 * b.greatest,
                100 * c.mean, 100 * c.greatest);
  }
}

/// Errors on clouds of the sphere, means over seeds and sources. Exact distances are those between the projections of
/// the points, noisy or denoised, onto the sphere.
void printSphere() {
  std::printf(
      "| sphere, distance | marching, mean | max | split twice, mean | max | heat, mean | max |\n"
      "|---|---|---|---|---|---|---|\n");
  constexpr std::uint64_t seeds = 3;
  struct Rows {
    double noise;
    bool moves;
    const char* name;
  };
  for (const auto& [noise, moves, name] :
       {Rows{0, false, ""}, Rows{0.01, false, ", noise 1 %"}, Rows{0.01, true, ", noise 1 %, moved"}}) {
    for (const int n : {1000, 4000, 16000, 64000}) {
      Error sums[3];
      for (std::uint64_t seed = first_seed; seed < first_seed + seeds; ++seed) {
        const shapes::Cloud clean = shapes::sphere(n, shapes::Sampling::uniform, seed);
        const Points noisy = noise > 0 ? shapes::withNoise(clean, noise, seed).points : clean.points;
        const Points points = moves ? denoise(noisy).positions : noisy;
        const Laplacian laplacian = pointCloudLaplacian(points);
        const int source = static_cast<int>(seed * 977 % static_cast<std::uint64_t>(n));
        const VectorXd exact = whereActive(shapes::sphereDistances(points.rowwise().normalized(), source), laplacian);
        const DistanceSolver solvers[] = {DistanceSolver(laplacian), DistanceSolver(laplacian, {.split = 2}),
                                          DistanceSolver(laplacian, by_heat)};
        for (int method = 0; method < 3; ++method) {
          const Error error = errorOf(solvers[method].query({source}), exact);
          sums[method].mean += error.mean / seeds, sums[method].greatest += error.greatest / seeds;
        }
      }
      std::printf("| %d%s ", n, name);
      for (const Error& error : sums) std::printf("| %.3f %% | %.2f %% ", 100 * error.mean, 100 * error.greatest);
      std::printf("|\n");
      std::fflush(stdout);
    }
  }
}

void printTorus() {
  std::printf(
      "| torus, distance | points | marching, mean | max | heat, mean | max |\n"
      "|---|---|---|---|---|---|\n");
  for (const int n : {4000, 16000}) {
    for (std::uint64_t seed = 101; seed < 104; ++seed) {
      const Torus torus = torusCloud(n, seed);
      const Laplacian laplacian = pointCloudLaplacian(torus.points);
      const Error a = errorOf(DistanceSolver(laplacian).query({0}), torus.exact);
      const Error b = errorOf(DistanceSolver(laplacian, by_heat).query({0}), torus.exact);
      std::printf("| seed %d | %d | %.3f %% | %.2f %% | %.3f %% | %.2f %% |\n", static_cast<int>(seed),
                  static_cast<int>(torus.points.rows()), 100 * a.mean, 100 * a.greatest, 100 * b.mean,
                  100 * b.greatest);
      std::fflush(stdout);
    }
  }
}

void printQuery() {
  std::printf(
      "| one thread, ms | a solve of L x = b | heat: set-up | a query | marching: set-up | a query | a query within a "
      "radius of 1,000 points |\n|---|---|---|---|---|---|---|\n");
  for (const int n : {16000, 100000, 1000000}) {
    const std::vector<std::pair<const char*, shapes::Cloud>> clouds = {{"sphere", shapes::sphere(n)},
                                                                       {"disk", shapes::disk(n)}};
    for (const auto& [name, cloud] : clouds) {
      const Laplacian laplacian = pointCloudLaplacian(cloud.points);
      laplacian.cover();
      const SolverOptions one_thread = {.threads = 1};
      const Solver poisson = Solver::laplacian(laplacian, one_thread);
      const VectorXd right = laplacian.M.cwiseProduct(cloud.points.col(0));
      const double solve = leastTime([&] { poisson.solve(right); });
      const DistanceSolver heat(laplacian, {.method = DistanceMethod::heat, .solver = one_thread});
      const double heat_query = leastTime([&] { heat.query({0}); });
      const DistanceSolver marching(laplacian, {.solver = one_thread});
      const double by_marching = leastTime([&] { marching.query({0}); });
      const double radius = std::sqrt(1000.0 / n * cloud.area / M_PI);
      const double near = leastTime([&] { pointsWithin(laplacian, {0}, radius); });
      std::printf("| %s, %d points | %.1f | %.0f | %.1f | %.0f | %.1f | %.2f |\n", name, n, solve,
                  1000 * heat.report().seconds, heat_query, 1000 * marching.report().seconds, by_marching, near);
      std::fflush(stdout);
    }
  }
}

}  // namespace tufted::bench
