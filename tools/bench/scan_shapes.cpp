#include <cmath>
#include <cstdio>
#include <utility>

#include "bench/scan_metrics.h"

namespace tufted::bench {
namespace {

using shapes::Cloud;
using shapes::Outliers;
using shapes::Rim;
using shapes::Sampling;
using Rule = Mark::Rule;
using Reference = Mark::Reference;

/// Numbers of eigenvalues for which the marks were set.
constexpr int few_eigenvalues = 29, scan_line_eigenvalues = 32, sphere_eigenvalues = 48, square_eigenvalues = 49;

Metric spectrum(int count, Mark mark, Yardstick yardstick = {}) {
  const auto measure = [count](const Build& build) { return spectrumError(build, count); };
  return {"eigenvalue error", Format::scientific, measure, std::move(mark), std::move(yardstick)};
}

Yardstick hull(int count) {
  return {"hull mesh", [count](const Sample& sample) { return hullSpectrumError(sample, count); }};
}

Metric area(Mark mark = {}) {
  return {"area", Format::signed_percent, areaError, std::move(mark), {}};
}

Mark atMost(double value, double stretch = shapes::unknown) {
  return {.rule = Rule::at_most, .value = value, .stretch = stretch};
}

/// The mark "at most `factor` times the core's figure".
Mark timesCore(double factor) {
  return {.rule = Rule::at_most, .reference = Reference::core, .factor = factor};
}

/// Collects cases, with a quarter of the points if `is_quick`.
class ShapeCases {
 public:
  ShapeCases(bool is_quick, std::vector<Case>& cases) : is_quick_(is_quick), cases_(cases) {}

  template <class Make>
  void add(const std::string& what, const std::string& shape, int n, Make make, const std::vector<Metric>& metrics,
           bool is_random = true) {
    const int points = is_quick_ ? n / 4 : n;
    cases_.push_back({.what = what,
                      .dataset = shape + ", " + std::to_string(points),
                      .make =
                          [make, points](std::uint64_t seed) {
                            return Sample{make(points, seed), {}};
                          },
                      .metrics = metrics,
                      .is_random = is_random,
                      .is_full_size = !is_quick_});
  }

 private:
  bool is_quick_;
  std::vector<Case>& cases_;
};

Cloud noisy(Cloud cloud, double sigma, std::uint64_t seed) {
  return shapes::withNoise(std::move(cloud), sigma, seed + 100);
}

void addScanLines(ShapeCases& cases) {
  for (const auto& [anisotropy, n] : {std::pair(10, 16000), {20, 16000}, {40, 64000}, {80, 64000}}) {
    const Sampling sampling = Sampling::scanLines(anisotropy);
    const Mark mark{.rule = Rule::at_most, .reference = Reference::yardstick};
    cases.add(
        "scan lines", "sphere 1:" + std::to_string(anisotropy), n,
        [sampling](int points, std::uint64_t) { return shapes::sphere(points, sampling); },
        {spectrum(scan_line_eigenvalues, mark, hull(scan_line_eigenvalues))}, false);
  }
}

void addNoise(ShapeCases& cases) {
  constexpr int n = 16000;
  for (const auto& [sigma, mark] : {std::pair(0.0025, 2.5e-3), {0.01, 9e-3}, {0.02, 3.3e-2}}) {
    char percent[16];
    std::snprintf(percent, sizeof percent, "%g %%", 100 * sigma);
    const double deviation = sigma;
    const std::vector<Metric> metrics{spectrum(few_eigenvalues, atMost(mark))};
    cases.add(
        "noise", std::string("sphere ") + percent, n,
        [deviation](int points, std::uint64_t seed) {
          return noisy(shapes::sphere(points, Sampling::uniform, seed), deviation, seed);
        },
        metrics);
    cases.add(
        "noise", std::string("torus ") + percent, n,
        [deviation](int points, std::uint64_t seed) {
          return noisy(shapes::torus(points, Sampling::uniform, seed), deviation, seed);
        },
        metrics);
  }
  cases.add("noise", "cube 1 %", n,
            [](int points, std::uint64_t seed) { return noisy(shapes::cubeSurface(points, seed), 0.01, seed); },
            {spectrum(few_eigenvalues, atMost(1.2e-2))});
  cases.add("noise", "crossing planes 1 %", n,
            [](int points, std::uint64_t seed) { return noisy(shapes::crossingPlanes(points, seed), 0.01, seed); },
            {spectrum(few_eigenvalues, atMost(0.1, 6e-2))});
}

void addClean(ShapeCases& cases) {
  constexpr int n = 16000;
  const auto add = [&](const std::string& shape, Cloud (*make)(int, std::uint64_t), int count, double factor) {
    cases.add("clean", shape, n, make, {spectrum(count, timesCore(factor)), area()});
  };
  using Seed = std::uint64_t;
  constexpr double alike = 1.02, worse = 1.2;
  add(
      "sphere", [](int m, Seed seed) { return shapes::sphere(m, Sampling::uniform, seed); }, few_eigenvalues, alike);
  add(
      "torus", [](int m, Seed seed) { return shapes::torus(m, Sampling::uniform, seed); }, few_eigenvalues, alike);
  add("cube", shapes::cubeSurface, few_eigenvalues, alike);
  add(
      "sphere, nonuniform", [](int m, Seed seed) { return shapes::sphere(m, Sampling::nonuniform, seed); },
      sphere_eigenvalues, alike);
  add(
      "sphere, density step 16", [](int m, Seed seed) { return shapes::sphere(m, Sampling::densityStep(16), seed); },
      sphere_eigenvalues, alike);
  add("crossing planes", shapes::crossingPlanes, few_eigenvalues, worse);
  add(
      "sphere, density step 100", [](int m, Seed seed) { return shapes::sphere(m, Sampling::densityStep(100), seed); },
      sphere_eigenvalues, worse);
}

void addSheets(ShapeCases& cases) {
  for (const auto& [spacings, mark] : {std::pair(2, 500), {4, 0}, {8, 0}}) {
    const int distance = spacings;
    cases.add("sheets", "distance of " + std::to_string(spacings) + " spacings", 8000,
              [distance](int points, std::uint64_t seed) {
                return shapes::twoSheets(points, distance * std::sqrt(2.0 / points), seed);  // either sheet has area 1
              },
              {{"bridges", Format::count, bridges, atMost(mark), {}}});
  }
}

void addOutliers(ShapeCases& cases) {
  for (const auto& [name, where] : {std::pair("near", Outliers::near), {"far", Outliers::far}}) {
    const Outliers place = where;
    cases.add("outliers", std::string("sphere, 1 % ") + name, 16000,
              [place](int points, std::uint64_t seed) {
                return shapes::withOutliers(shapes::sphere(points, Sampling::uniform, seed), place, 0.01, seed + 100);
              },
              {spectrum(sphere_eigenvalues, atMost(1e-2)), area({.rule = Rule::off_by_at_most, .value = 5e-3})});
  }
}

void addRims(ShapeCases& cases) {
  using Seed = std::uint64_t;
  using Open = Cloud (*)(int, Sampling, Rim, Seed);
  const Mark covered{.rule = Rule::off_by_at_most, .value = 4.5e-3};
  for (const auto& [name, make] : {std::pair<const char*, Open>("square", shapes::square), {"disk", shapes::disk}}) {
    const Open shape = make;
    cases.add("no rim points", name, 32000,
              [shape](int points, Seed seed) { return shape(points, Sampling::uniform, Rim::none, seed); },
              {spectrum(square_eigenvalues, atMost(2.5e-3)), area(covered)});
  }
  const Mark tagged{.rule = Rule::at_least, .value = 0.95};
  const std::vector<Metric> tags{{"recall of tags", Format::percent, boundaryRecall, tagged, {}},
                                 {"precision of tags", Format::percent, boundaryPrecision, tagged, {}}};
  std::vector<Metric> patch{spectrum(sphere_eigenvalues, atMost(1.6e-3, 1.3e-3)), area()};
  patch.insert(patch.end(), tags.begin(), tags.end());
  for (const auto& [name, make] : {std::pair<const char*, Open>("cylinder patch", shapes::cylinderPatch),
                                   {"square", shapes::square},
                                   {"disk", shapes::disk},
                                   {"saddle", shapes::saddle}}) {
    const Open shape = make;
    cases.add(
        "rimmed", name, 32000,
        [shape](int points, Seed seed) { return shape(points, Sampling::uniform, Rim::included, seed); },
        shape == shapes::cylinderPatch ? patch : tags);
  }
}

void addPoisson(ShapeCases& cases) {
  for (const auto& [n, mark] : {std::pair(16000, 1.8e-3), {64000, 4.5e-4}}) {
    cases.add("Poisson", "sphere", n,
              [](int points, std::uint64_t seed) { return shapes::sphere(points, Sampling::uniform, seed); },
              {{"L2 error",
                Format::scientific,
                [](const Build& build) { return poissonError(build); },
                atMost(mark),
                {"hull mesh", hullPoissonError}}});
  }
}

}  // namespace

void addShapes(bool is_quick, std::vector<Case>& cases) {
  ShapeCases shape_cases(is_quick, cases);
  addScanLines(shape_cases);
  addNoise(shape_cases);
  addClean(shape_cases);
  addSheets(shape_cases);
  addOutliers(shape_cases);
  addRims(shape_cases);
  addPoisson(shape_cases);
}

}  // namespace tufted::bench
