#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "oracles/classic_heat.h"
#include "oracles/geodesics.h"
#include "oracles/oracles.h"
#include "oracles/planar.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/distance.h"
#include "tufted/errors.h"
#include "tufted/interpolation.h"
#include "tufted/io/read.h"
#include "tufted/path.h"

// Tables of what distances, interpolation and Green's functions reach, in Markdown.

namespace {

using tufted::DistanceSolver;
using tufted::Laplacian;
using tufted::Points;
using tufted::VectorXd;
namespace oracles = tufted::oracles;
namespace shapes = tufted::shapes;

class Stopwatch {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Errors of distances, where the exact distance is finite; infinite if one of these distances is not finite.
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

const tufted::DistanceOptions by_heat = {.method = tufted::DistanceMethod::heat};

/// Calls visit(file, geometry, exact distances from the first corner of the first triangle) for those of CGAL's meshes
/// that its exact search takes and is done with soon.
template <class Visit>
void forEachMesh(const Visit& visit) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(TUFTED_CGAL_DATA_DIR "/meshes")) files.push_back(entry);
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    tufted::Geometry geometry;
    try {
      geometry = tufted::read(file);
    } catch (const tufted::IoError&) {
      continue;
    }
    if (geometry.triangles.rows() < 100 || geometry.triangles.rows() > 6000) continue;
    if (const auto exact = oracles::exactDistances(geometry.points, geometry.triangles, 0, {1, 0, 0}))
      visit(file, geometry, *exact);
  }
}

void printMeshes() {
  std::printf(
      "| mesh | triangles | marching, mean | max | heat, mean | max | heat by cotan, mean | max |\n"
      "|---|---|---|---|---|---|---|---|\n");
  std::vector<double> marching, heat, theirs;
  int better = 0;
  forEachMesh([&](const std::filesystem::path& file, const tufted::Geometry& geometry, const VectorXd& exact) {
    const int source = geometry.triangles(0, 0);
    const Laplacian laplacian = tufted::meshLaplacian(geometry.points, geometry.triangles);
    const Error m = errorOf(DistanceSolver(laplacian).query({source}), exact);
    const Error a = errorOf(DistanceSolver(laplacian, by_heat).query({source}), exact);
    const Error b = errorOf(oracles::classicHeatDistances(geometry.points, geometry.triangles, source), exact);
    const bool has_theirs = std::isfinite(b.mean);  // else its matrix has no factor
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

/// The shares of paths that are longer than exact ones by more than half a percent and than one percent.
struct PathCount {
  int pairs = 0, half = 0, one = 0;
  double least = 0, worst = 0;  ///< by which part of the exact length any is longer

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

void printPaths() {
  std::printf(
      "| paths | pairs | longer by 0.5 %% | by 1 %% | least excess | greatest | ms for each |\n"
      "|---|---|---|---|---|---|---|\n");
  constexpr std::uint64_t seed = 101;
  constexpr int targets = 100;
  shapes::Random random(seed);
  const auto drawn = [&random](Eigen::Index n) { return static_cast<int>(random.uniform() * static_cast<double>(n)); };
  PathCount meshes;
  double milliseconds = 0;
  forEachMesh([&](const std::filesystem::path&, const tufted::Geometry& geometry, const VectorXd& exact) {
    const Laplacian laplacian = tufted::meshLaplacian(geometry.points, geometry.triangles);
    const tufted::PathSolver solver(laplacian, 1);
    const Stopwatch watch;
    for (int t = 0; t < targets; ++t) {
      const int to = drawn(exact.size());
      if (exact[to] > 0) meshes.add(solver.path(geometry.triangles(0, 0), to).length, exact[to]);
    }
    milliseconds += watch.milliseconds();
  });
  meshes.print("CGAL's meshes", milliseconds);
  for (const int n : {4000, 16000, 64000}) {
    const Points points = shapes::sphere(n, shapes::Sampling::uniform, seed).points;
    const tufted::PathSolver solver(tufted::pointCloudLaplacian(points), 1);
    PathCount clouds;
    const int from = drawn(n);
    const VectorXd exact = shapes::sphereDistances(points, from);
    const Stopwatch watch;
    for (int t = 0; t < targets; ++t) {
      const int to = drawn(n);
      if (exact[to] > 0) clouds.add(solver.path(from, to).length, exact[to]);
    }
    clouds.print(("sphere, " + std::to_string(n) + " points").c_str(), watch.milliseconds());
  }
}

/// Figure 15: how far harmonic functions leave the range of their pins, over that range.
void printObtuse() {
  std::printf("| square, obtuse boundary | cotan | intrinsic Delaunay | ours |\n|---|---|---|---|\n");
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const oracles::PlanarMesh given = oracles::obtuseSquare(200, 8, seed),
                              delaunay = oracles::obtuseSquare(200, 1, seed);
    const auto [pinned, values] = oracles::pinsAtObtuseCorners(given);
    const tufted::Pins pins{pinned, values};
    const auto outside = [&](const oracles::PlanarMesh& mesh, bool cotan) {
      Laplacian laplacian = tufted::meshLaplacian(mesh.points, mesh.triangles);
      if (cotan) laplacian.L = oracles::cotanLaplacian(mesh.points, mesh.triangles).L;
      const Eigen::MatrixXd u = tufted::harmonic(laplacian, pins);
      return std::max({0.0, -u.minCoeff(), u.maxCoeff() - 1});
    };
    std::printf("| sample %d | %.3g | %.3g | %.3g |\n", static_cast<int>(seed), outside(given, true),
                outside(delaunay, true), outside(given, false));
  }
}

/// Figure 16: three pages at a spine, exact distances by unfolding.
void printNonmanifold() {
  std::printf(
      "| three pages, slivers | vertices | cotan, mean | max | heat, mean | max | marching, mean | max |\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (const double stretch : {1.0, 4.0, 16.0}) {
    const oracles::Book book = oracles::badBook(3, 40, stretch, 1);
    const int source = 41 + 500;  // inside the first page
    const VectorXd exact = oracles::bookDistances(book, source);
    const Error a = errorOf(oracles::classicHeatDistances(book.points, book.triangles, source), exact);
    const Laplacian laplacian = tufted::meshLaplacian(book.points, book.triangles);
    const Error b = errorOf(DistanceSolver(laplacian, by_heat).query({source}), exact);
    const Error c = errorOf(DistanceSolver(laplacian).query({source}), exact);
    std::printf("| stretched %g times | %d | %.1f %% | %.1f %% | %.1f %% | %.1f %% | %.2f %% | %.2f %% |\n", stretch,
                static_cast<int>(exact.size()), 100 * a.mean, 100 * a.greatest, 100 * b.mean, 100 * b.greatest,
                100 * c.mean, 100 * c.greatest);
  }
}

/// Mean over seeds and sources of the errors on clouds of the sphere.
void printSphere() {
  std::printf(
      "| sphere, distance | marching, mean | max | split twice, mean | max | heat, mean | max |\n"
      "|---|---|---|---|---|---|---|\n");
  constexpr std::uint64_t first_seed = 101, seeds = 3;
  for (const double noise : {0.0, 0.01}) {
    for (const int n : {1000, 4000, 16000, 64000}) {
      Error sums[3];
      for (std::uint64_t seed = first_seed; seed < first_seed + seeds; ++seed) {
        const shapes::Cloud clean = shapes::sphere(n, shapes::Sampling::uniform, seed);
        const Points points = noise > 0 ? shapes::withNoise(clean, noise, seed).points : clean.points;
        const Laplacian laplacian = tufted::pointCloudLaplacian(points);
        const int source = static_cast<int>(seed * 977 % static_cast<std::uint64_t>(n));
        const VectorXd exact = shapes::sphereDistances(clean.points, source);
        const DistanceSolver solvers[] = {DistanceSolver(laplacian), DistanceSolver(laplacian, {.split = 2}),
                                          DistanceSolver(laplacian, by_heat)};
        for (int method = 0; method < 3; ++method) {
          const Error error = errorOf(solvers[method].query({source}), exact);
          sums[method].mean += error.mean / seeds, sums[method].greatest += error.greatest / seeds;
        }
      }
      std::printf("| %d%s ", n, noise > 0 ? ", noise 1 %" : "");
      for (const Error& error : sums) std::printf("| %.3f %% | %.2f %% ", 100 * error.mean, 100 * error.greatest);
      std::printf("|\n");
      std::fflush(stdout);
    }
  }
}

/// L2 error beyond 4 edges of the source.
double greenError(const Laplacian& laplacian, const Points& points, double edge) {
  const Eigen::MatrixXd g = tufted::greensFunction(laplacian, {0});
  double square = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double chord = (points.row(i) - points.row(0)).norm();
    if (chord < 4 * edge) continue;
    const double error = g(i, 0) + (std::log(chord * chord / 4) + 1) / (4 * M_PI);
    square += laplacian.M[i] * error * error;
  }
  return std::sqrt(square);
}

void printGreen() {
  std::printf("| sphere, Green's function | cloud, L2 | hull mesh |\n|---|---|---|\n");
  for (const int n : {4000, 16000, 64000}) {
    const Points points = shapes::sphere(n).points;
    const Laplacian cloud = tufted::pointCloudLaplacian(points);
    const Laplacian hull = tufted::meshLaplacian(points, oracles::convexHullMesh(points));
    const double edge = std::sqrt(cloud.report.mean_squared_edge);
    std::printf("| %d | %.2e | %.2e |\n", n, greenError(cloud, points, edge), greenError(hull, points, edge));
  }
}

/// Best of ten, as the machine may be shared.
double leastTime(const std::function<void()>& work) {
  double least = HUGE_VAL;
  for (int repetition = 0; repetition < 10; ++repetition) {
    const Stopwatch watch;
    work();
    least = std::min(least, watch.milliseconds());
  }
  return least;
}

void printQuery() {
  std::printf(
      "| one thread, ms | a solve of L x = b | heat: set-up | a query | marching: set-up | a query | a query within a "
      "radius of 1,000 points |\n|---|---|---|---|---|---|---|\n");
  for (const int n : {16000, 100000, 1000000}) {
    const std::vector<std::pair<const char*, shapes::Cloud>> clouds = {{"sphere", shapes::sphere(n)},
                                                                       {"disk", shapes::disk(n)}};
    for (const auto& [name, cloud] : clouds) {
      const Laplacian laplacian = tufted::pointCloudLaplacian(cloud.points);
      laplacian.cover();
      const tufted::SolverOptions one_thread = {.threads = 1};
      const tufted::Solver poisson = tufted::Solver::laplacian(laplacian, one_thread);
      const VectorXd right = laplacian.M.cwiseProduct(cloud.points.col(0));
      const double solve = leastTime([&] { poisson.solve(right); });
      const DistanceSolver heat(laplacian, {.method = tufted::DistanceMethod::heat, .solver = one_thread});
      const double heat_query = leastTime([&] { heat.query({0}); });
      const DistanceSolver marching(laplacian, {.solver = one_thread});
      const double by_marching = leastTime([&] { marching.query({0}); });
      const double radius = std::sqrt(1000.0 / n * cloud.area / M_PI);
      const double near = leastTime([&] { tufted::pointsWithin(laplacian, {0}, radius); });
      std::printf("| %s, %d points | %.1f | %.0f | %.1f | %.0f | %.1f | %.2f |\n", name, n, solve,
                  1000 * heat.report().seconds, heat_query, 1000 * marching.report().seconds, by_marching, near);
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::map<std::string, void (*)()> tables = {
      {"meshes", printMeshes}, {"obtuse", printObtuse}, {"nonmanifold", printNonmanifold},
      {"sphere", printSphere}, {"green", printGreen},   {"query", printQuery},
      {"paths", printPaths}};
  CLI::App app("Tables of distances, interpolation and Green's functions against what is exact.");
  std::vector<std::string> names;
  std::vector<std::string> known;
  for (const auto& [name, print] : tables) known.push_back(name);
  app.add_option("TABLE", names, "Which (all)")->check(CLI::IsMember(known));
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& name : names.empty() ? known : names) {
      tables.at(name)();
      std::printf("\n");
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tufted_applications: %s\n", error.what());
    return 1;
  }
}
