// tufted_scans: how well builds treat clouds of scanners, noise, outliers, sheets and rims. See --help.
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/star_union.h"
#include "oracles/oracles.h"
#include "shapes/shapes.h"
#include "tufted/laplacian.h"

namespace tufted::bench {
namespace {

using shapes::Cloud;
using shapes::Outliers;
using shapes::RoomSurface;
using shapes::Sampling;
using Seed = std::uint64_t;

struct Sample {
  Cloud cloud;
  shapes::ScanTruth truth{};  ///< rooms only: the same rays without noise
};

struct Variant {
  const char* name;
  Preset preset;
  bool by_rings;
};

/// One build of one sample.
struct Build {
  Build(const Sample& of, const Variant& variant) : sample(of), options(cloudOptions(variant.preset)) {
    if (variant.by_rings) {
      std::vector<int> ring;
      for (int i = 0; i < of.cloud.width * of.cloud.height; ++i) ring.push_back(i / of.cloud.width);
      structure = ringStructure(of.cloud.points, std::move(ring));
      options.structure = &*structure;
    }
    laplacian = pointCloudLaplacian(of.cloud.points, options);
  }
  Build(const Build&) = delete;  // the options point to the structure

  Triangles stars() const { return unionOfStars(sample.cloud.points, options, laplacian); }

  const Sample& sample;
  std::optional<ScanStructure> structure;
  CloudOptions options;
  Laplacian laplacian;
};

struct Figure {
  std::string name;
  std::function<double(const Build&)> of;
};

struct Case {
  std::string name;
  std::function<Sample(Seed)> make;
  std::vector<Figure> figures;
  bool is_random = true;  ///< false: every seed gives the same cloud, so one is enough
};

/// Mean relative error of the first `count` eigenvalues after the first zero.
double spectrumError(const SparseMatrix& L, const VectorXd& M, const Cloud& cloud, int count) {
  return oracles::meanRelativeError(oracles::smallestEigenvalues(L, M, count + 1), cloud.eigenvalues.head(count + 1));
}

Figure spectrum(int count) {
  return {std::to_string(count) + " eigenvalues", [count](const Build& build) {
            // Every component adds an eigenvalue 0; if all are 0, the relative error is 1.
            if (build.laplacian.report.components > count) return 1.0;
            return spectrumError(build.laplacian.L, build.laplacian.M, build.sample.cloud, count);
          }};
}

/// The error of the cotan Laplacian of the convex hull of the points, whatever the build is.
Figure hullSpectrum(int count) {
  return {"of the convex hull", [count](const Build& build) {
            const Points& points = build.sample.cloud.points;
            const auto [L, M] = oracles::cotanLaplacian(points, oracles::convexHullMesh(points));
            return spectrumError(L, M, build.sample.cloud, count);
          }};
}

bool hasOneLabel(const std::vector<int>& labels, const Eigen::RowVector3i& triangle) {
  return labels[triangle[1]] == labels[triangle[0]] && labels[triangle[2]] == labels[triangle[0]];
}

/// Triangles of the union of stars, all copies counted, whose corners do not all have one label.
double bridges(const Build& build) {
  const Triangles stars = build.stars();
  int count = 0;
  for (const auto& triangle : stars.rowwise())
    if (!hasOneLabel(build.sample.cloud.labels, triangle)) ++count;
  return count;
}

/// 0 for the labels of floor, ceiling and walls, 1 for the box, 2 for the pole.
int bodyOf(int label) {
  if (label == static_cast<int>(RoomSurface::pole)) return 2;
  return label < static_cast<int>(RoomSurface::box_west) ? 0 : 1;
}

/// Share of the area of the union of stars in triangles between bodies that the scanner sees one behind the other.
double areaAcrossJumps(const Build& build) {
  const Points& points = build.sample.cloud.points;
  const std::vector<int>& labels = build.sample.cloud.labels;
  const Triangles stars = build.stars();
  double across = 0, whole = 0;
  for (const auto& triangle : stars.rowwise()) {
    const Eigen::Vector3d a = points.row(triangle[0]), b = points.row(triangle[1]), c = points.row(triangle[2]);
    const double area = (b - a).cross(c - a).norm();
    bool jumps = false;
    for (int k = 0; k < 3; ++k) {
      const int i = triangle[k], j = triangle[(k + 1) % 3];
      jumps |= bodyOf(labels[i]) != bodyOf(labels[j]) && shapes::crossesJump(points.row(i), points.row(j));
    }
    whole += area;
    if (jumps) across += area;
  }
  return across / whole;
}

/// Share of the inner rays whose star is closed and complete.
double closedInnerStars(const Build& build) {
  const std::vector<std::uint8_t>& is_inner = build.sample.truth.inner;
  int inner = 0, closed = 0;
  for (std::size_t i = 0; i < is_inner.size(); ++i) {
    if (is_inner[i] == 0) continue;
    ++inner;
    if (build.laplacian.status[i] == PointStatus::active && build.laplacian.boundary[i] == Boundary::none) ++closed;
  }
  return static_cast<double>(closed) / inner;
}

const Figure area_error = {"area", [](const Build& build) {
                             const Sample& sample = build.sample;
                             const double truth = sample.truth.inner.empty() ? sample.cloud.area : sample.truth.area;
                             return build.laplacian.M.sum() / truth - 1;
                           }};

/// Surfaces whose spectrum is known, and sheets.
std::vector<Case> shapeCases() {
  constexpr int n = 16000;
  const auto sphere = [](const Sampling& sampling) {
    return [sampling](Seed seed) { return shapes::sphere(n, sampling, seed); };
  };
  const auto torus = [](Seed seed) { return shapes::torus(n, Sampling::uniform, seed); };
  const auto cube = [](Seed seed) { return shapes::cubeSurface(n, seed); };
  const auto planes = [](Seed seed) { return shapes::crossingPlanes(n, seed); };
  const auto square = [](Seed seed) { return shapes::square(2 * n, Sampling::uniform, shapes::Rim::none, seed); };
  std::vector<Case> cases;
  const auto add = [&](const std::string& name, const std::function<Cloud(Seed)>& make, std::vector<Figure> figures) {
    cases.push_back({name, [make](Seed seed) { return Sample{make(seed)}; }, std::move(figures)});
  };
  const auto addNoisy = [&](const std::string& shape, const std::function<Cloud(Seed)>& make, double sigma) {
    char percent[32];
    std::snprintf(percent, sizeof percent, ", noise %g %%", 100 * sigma);
    add(shape + percent, [make, sigma](Seed seed) { return shapes::withNoise(make(seed), sigma, seed + 100); },
        {spectrum(29)});
  };
  for (const int anisotropy : {10, 20, 40, 80}) {
    const int points = anisotropy < 40 ? n : 4 * n;
    const auto lines = [=](Seed) { return shapes::sphere(points, Sampling::scanLines(anisotropy)); };
    add("sphere, scan lines 1:" + std::to_string(anisotropy), lines, {spectrum(32), hullSpectrum(32)});
    cases.back().is_random = false;
  }
  for (const double sigma : {0.0025, 0.01, 0.02}) {
    addNoisy("sphere", sphere(Sampling::uniform), sigma);
    addNoisy("torus", torus, sigma);
  }
  addNoisy("cube", cube, 0.01);
  addNoisy("crossing planes", planes, 0.01);
  add("sphere, exact", sphere(Sampling::uniform), {spectrum(29), area_error});
  add("torus, exact", torus, {spectrum(29), area_error});
  add("cube, exact", cube, {spectrum(29), area_error});
  add("crossing planes, exact", planes, {spectrum(29), area_error});
  for (const int ratio : {16, 100})
    add("sphere, density step " + std::to_string(ratio), sphere(Sampling::densityStep(ratio)), {spectrum(48)});
  for (const auto& [name, where] : {std::pair("near", Outliers::near), {"anywhere", Outliers::far}}) {
    const Outliers place = where;
    const auto outliers = [place](Seed seed) {
      return shapes::withOutliers(shapes::sphere(n, Sampling::uniform, seed), place, 0.01, seed + 100);
    };
    add(std::string("sphere, 1 % outliers ") + name, outliers, {spectrum(48), area_error});
  }
  add("square without points on its rim", square, {spectrum(49), area_error});
  for (const int spacings : {2, 4, 8}) {
    const auto sheets = [spacings](Seed seed) {
      return shapes::twoSheets(n / 2, spacings * std::sqrt(4.0 / n), seed);  // either sheet has area 1
    };
    add("sheets " + std::to_string(spacings) + " spacings apart", sheets, {{"triangles between them", bridges}});
  }
  return cases;
}

/// Azimuths start at another fraction of a step for each seed, so that rooms without noise differ too.
Sample room(shapes::LidarOptions options, Seed seed) {
  constexpr double golden = 0.6180339887498949;
  options.first_azimuth = golden * static_cast<double>(seed - 1) - std::floor(golden * static_cast<double>(seed - 1));
  shapes::LidarOptions without_noise = options;
  without_noise.noise = 0;
  return {shapes::lidar(options, seed), shapes::scanTruth(shapes::lidar(without_noise), true)};
}

/// Rooms seen by spinning scanners.
std::vector<Case> roomCases() {
  std::vector<Case> cases;
  for (const double noise : {0.0, 0.02}) {
    for (const int rings : {16, 32, 64}) {
      for (const double step : {0.1, 0.2}) {
        char name[64];
        std::snprintf(name, sizeof name, "lidar, %d rings, %g deg, noise %g cm", rings, step, 100 * noise);
        const shapes::LidarOptions options{.rings = rings, .azimuth_step = step, .noise = noise};
        cases.push_back(
            {name,
             [options](Seed seed) { return room(options, seed); },
             {{"closed inner stars", closedInnerStars}, area_error, {"wrong, across jumps", areaAcrossJumps}}});
      }
    }
  }
  return cases;
}

/// Prints mean and range over the seeds for every build of a case.
void print(const Case& c, const std::vector<Variant>& variants, int first_seed, int seeds) {
  std::vector<std::vector<VectorXd>> values(c.figures.size(), std::vector<VectorXd>(variants.size(), VectorXd(seeds)));
  for (int s = 0; s < seeds; ++s) {
    const Sample sample = c.make(static_cast<Seed>(first_seed + s));
    for (std::size_t v = 0; v < variants.size(); ++v) {
      const Build build(sample, variants[v]);
      for (std::size_t f = 0; f < c.figures.size(); ++f) values[f][v][s] = c.figures[f].of(build);
    }
  }
  for (std::size_t f = 0; f < c.figures.size(); ++f) {
    for (std::size_t v = 0; v < variants.size(); ++v) {
      const VectorXd& x = values[f][v];
      std::printf("| %s | %s | %s | %.4g | %.4g to %.4g |\n", c.name.c_str(), c.figures[f].name.c_str(),
                  variants[v].name, x.mean(), x.minCoeff(), x.maxCoeff());
    }
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace tufted::bench

int main(int argc, char** argv) {
  namespace bench = tufted::bench;
  using tufted::Preset;
  int first_seed = 101, seeds = 5;
  std::string filter;
  CLI::App app("Errors of builds on scans, noise, outliers, sheets and rims.");
  app.add_option("--seeds", seeds, "Samples per cloud")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--first-seed", first_seed, "Of the samples; constants of the library were chosen on 1 to 9")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--filter", filter, "Only clouds whose name contains this");
  CLI11_PARSE(app, argc, argv);
  const auto run = [&](const std::vector<bench::Case>& cases, const std::vector<bench::Variant>& variants) {
    for (const bench::Case& c : cases)
      if (c.name.find(filter) != std::string::npos) bench::print(c, variants, first_seed, c.is_random ? seeds : 1);
  };
  try {
    std::printf("| cloud | error | build | mean | range |\n|---|---|---|---|---|\n");
    run(bench::shapeCases(), {{"clean", Preset::clean, false}, {"scan", Preset::scan, false}});
    run(bench::roomCases(),
        {{"clean", Preset::clean, false}, {"lidar", Preset::lidar, false}, {"rings", Preset::lidar, true}});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tufted_scans: %s\n", error.what());
    return 1;
  }
}
