// The maximum principle and Green's functions.
#include <array>
#include <cmath>
#include <stdexcept>

#include "base/stage_clock.h"
#include "bench/compare/solves.h"
#include "bench/compare/tables.h"
#include "oracles/planar.h"
#include "shapes/random.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace tufted::bench {
namespace {

/// By how much u leaves [0, 1], the range of its pins; values that are not finite are left out.
double overshootOf(const Eigen::MatrixXd& u) {
  double worst = 0;
  for (const double value : u.reshaped())
    if (std::isfinite(value)) worst = std::max({worst, -value, value - 1});
  return worst;
}

/// A tenth of the points, so that negative weights reach pins, with random values 0 and 1, the extremes of the range.
Pinned randomPins(Eigen::Index points, std::uint64_t seed) {
  constexpr int functions = 4;
  const Eigen::Index pinned = points / 10;
  shapes::Random random(seed);
  Pinned pins{random.permutation(static_cast<int>(points)), Eigen::MatrixXd(pinned, functions)};
  pins.points.resize(static_cast<std::size_t>(pinned));
  for (double& value : pins.values.reshaped()) value = random.below(2);
  return pins;
}

/// The meshes of the table: real shapes, files, and squares with obtuse angles (the paper's Figure 15).
std::vector<shapes::Mesh> meshesOf(const Settings& settings) {
  constexpr Eigen::Index fewest = 200, most = 12000;  // triangles: with more, all rivals take too long
  std::vector<shapes::Mesh> meshes;
  std::vector<std::filesystem::path> files;
  for (const auto& folder : {settings.meshes, settings.real / "shapes"})
    if (exists(folder))
      for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry);
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    shapes::Mesh mesh;
    try {
      const Geometry geometry = read(file, ReadAs::mesh);
      mesh.points = geometry.points, mesh.triangles = geometry.triangles;
    } catch (const IoError&) {
      continue;  // the folder holds other files too
    }
    if (mesh.triangles.rows() >= fewest && mesh.triangles.rows() <= most) meshes.push_back(mesh);
  }
  for (const double stretch : {1.0, 4.0, 16.0}) {
    oracles::PlanarMesh square = oracles::obtuseSquare(500, stretch, settings.first_seed);
    meshes.emplace_back();
    meshes.back().points = square.points, meshes.back().triangles = square.triangles;
  }
  return meshes;
}

/// Overshoots of a rival on all data.
struct Overshoots {
  int broken = 0, failed = 0, tried = 0;
  double worst = 0, positive = 0, empty = 0;
  std::vector<double> all;

  /// @param build returns the operators of one mesh or cloud, or throws std::runtime_error
  template <class Build>
  void add(const Build& build, bool symmetric, std::uint64_t seed) {
    constexpr double rounding = 1e-9;
    try {
      const Operators operators = build();
      ++tried;
      positive += positiveShare(operators.L);
      empty += (operators.L.diagonal().array() == 0).cast<double>().mean();
      const Pinned pins = randomPins(operators.L.rows(), seed);
      const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(operators.L.rows(), pins.values.cols());
      const auto u = solvePinned(operators.L, symmetric, zero, pins);
      if (!u) {
        ++failed;
        return;
      }
      all.push_back(overshootOf(*u));
      worst = std::max(worst, all.back());
      if (all.back() > rounding) ++broken;
    } catch (const std::runtime_error&) {  // the method does not apply
    }
  }
  std::vector<Cell> row(const char* kind, const std::string& name) const {
    return {kind,
            name,
            tried,
            broken,
            all.empty() ? Cell("") : percent(medianOfAll(all), "%.2g %%"),
            percent(worst, "%.3g %%"),
            percent(positive / std::max(tried, 1)),
            percent(empty / std::max(tried, 1)),
            failed};
  }
};

}  // namespace

Json printBoundary(const Settings& settings) {
  const std::vector<shapes::Mesh> meshes = meshesOf(settings);
  Table table({"data", "Laplacian", "of " + std::to_string(meshes.size()) + " it applies to", "it overshoots on",
               "median overshoot", "greatest", "positive off-diagonals", "points without row", "no solution"});
  for (const MeshRival& rival : meshRivals()) {
    Overshoots found;
    for (const shapes::Mesh& mesh : meshes)
      found.add([&] { return rival.build(mesh.points, mesh.triangles); }, true, settings.first_seed);
    table.row(found.row("meshes", rival.name));
  }
  for (const CloudRival& rival : rivalsOf(settings)) {
    Overshoots found;
    for (const shapes::Mesh& mesh : meshes)
      found.add([&] { return rival.build(mesh.points, rival.k); }, rival.symmetric, settings.first_seed);
    table.row(found.row("vertices", rival.name));
  }
  return table.json();
}

Json printGreen(const Settings& settings) {
  constexpr int sources = 4;
  const int n = settings.pointsOr(4000);
  std::vector<Points> clouds;
  for (const RealShape& shape : shapesOf(settings, 0)) {
    if (clouds.size() == 3) break;
    clouds.push_back(sampleOf(shape, n, settings.noise, settings.first_seed).points);
  }
  Table table(
      {"Laplacian", "k", "nonzeros per row", "build, s", "factor, s", "solve, ms", "least value over greatest"});
  for (const CloudRival& rival : rivalsOf(settings)) {
    for (const int k : {15, 30, 60}) {
      double entries = 0, build = 0, factor = 0, solve = 0, least = 0;
      bool failed = false;
      for (const Points& points : clouds) {
        const Stopwatch watch;
        const Operators operators = rival.build(points, k);
        build += watch.seconds();
        entries += static_cast<double>(operators.L.nonZeros()) / n;
        const std::vector<int> drawn = shapes::Random(settings.first_seed).permutation(n);
        Eigen::MatrixXd f = Eigen::MatrixXd::Zero(n, sources);
        for (int s = 0; s < sources; ++s) f(drawn[s + 1], s) = 1;
        std::array<double, 2> seconds{};
        const auto green =
            solvePinned(operators.L, rival.symmetric, f, {{drawn[0]}, Eigen::MatrixXd::Zero(1, sources)}, &seconds);
        factor += seconds[0], solve += seconds[1] / sources;
        failed = failed || !green;
        for (int s = 0; green && s < sources; ++s) {
          double low = 0, high = 0;
          for (const double value : green->col(s))
            if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
          if (high > 0) least = std::min(least, low / high);
        }
      }
      const auto count = static_cast<double>(clouds.size());
      table.row({rival.name, k, Cell("%.1f", entries / count), Cell("%.2f", build / count),
                 Cell("%.2f", factor / count), Cell("%.1f", 1000 * solve / count),
                 failed ? Cell("no factor") : Cell("%.2g", least)});
    }
  }
  return table.json();
}

}  // namespace tufted::bench
