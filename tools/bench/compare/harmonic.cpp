// The maximum principle and Green's functions.
#include <array>
#include <cmath>
#include <stdexcept>

#include "base/median.h"
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
  for (const auto& file : filesIn({settings.meshes, settings.real / "shapes"})) {
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
  Buffer<double> all;

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
    const double share = 1.0 / std::max(tried, 1);
    const Cell median = all.empty() ? Cell("") : percent(medianOf(all), "%.2g %%");
    const Cell greatest = percent(worst, "%.3g %%");
    return {kind, name, tried, broken, median, greatest, percent(positive * share), percent(empty * share), failed};
  }
};

}  // namespace

Table printBoundary(const Settings& settings) {
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
  return table;
}

Table printGreen(const Settings& settings) {
  constexpr std::array<int, 3> neighbors = {15, 30, 60};
  constexpr int sources = 4, most_clouds = 3;
  const int n = settings.pointsOr(4000);
  std::vector<Points> clouds;
  for (const RealShape& shape : shapesOf(settings, 0))
    if (clouds.size() < most_clouds) clouds.push_back(sampleOf(shape, n, settings.noise, settings.first_seed).points);
  const std::vector<int> drawn = shapes::Random(settings.first_seed).permutation(n);
  const Pinned sink = {{drawn[0]}, Eigen::MatrixXd::Zero(1, sources)};
  Eigen::MatrixXd f = Eigen::MatrixXd::Zero(n, sources);
  for (int s = 0; s < sources; ++s) f(drawn[s + 1], s) = 1;
  Table table(
      {"Laplacian, k = 15; 30; 60", "nonzeros per row", "build, s", "factor, s", "solve, ms", "least over greatest"});
  for (const CloudRival& rival : rivalsOf(settings)) {
    std::vector<Cell> row = {rival.name, "", "", "", "", ""};
    const auto add = [&row](std::size_t column, const Cell& cell) {
      row[column].text += (row[column].text.empty() ? "" : "; ") + cell.text;
      if (!row[column].value.is_array()) row[column].value = nlohmann::ordered_json::array();
      row[column].value.push_back(cell.value);
    };
    for (const int k : neighbors) {
      double entries = 0, build = 0, least = 0;
      std::array<double, 2> solve{};
      bool failed = false;
      for (const Points& points : clouds) {
        const auto share = 1 / static_cast<double>(clouds.size());
        const Stopwatch watch;
        const Operators operators = rival.build(points, k);
        build += share * watch.seconds();
        entries += share * static_cast<double>(operators.L.nonZeros()) / n;
        std::array<double, 2> seconds{};
        const auto green = solvePinned(operators.L, rival.symmetric, f, sink, &seconds);
        for (int i = 0; i < 2; ++i) solve[i] += share * seconds[i];
        failed = failed || !green;
        for (int s = 0; green && s < sources; ++s) {
          failed = failed || !std::isfinite((*green)(drawn[s + 1], s));  // the sink or the source has no row
          const VectorXd g = green->col(s).array().isFinite().select(green->col(s), 0);
          if (g.maxCoeff() > 0) least = std::min(least, g.minCoeff() / g.maxCoeff());
        }
      }
      add(1, Cell("%.0f", entries));
      add(2, Cell("%.2f", build));
      add(3, Cell("%.2f", solve[0]));
      add(4, Cell("%.1f", 1000 * solve[1] / sources));
      add(5, failed ? Cell("no factor") : Cell("%.2g", least));
    }
    table.row(row);
  }
  return table;
}

}  // namespace tufted::bench
