#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "bench/scan_metrics.h"
#include "tufted/io/read.h"

namespace tufted::bench {
namespace {

namespace fs = std::filesystem;
using shapes::LidarOptions;
using Rule = Mark::Rule;
using Reference = Mark::Reference;

double surfacesOf(const Sample& sample) {
  return sample.truth.surfaces;
}

/// Azimuths start at another fraction of a step for each seed, so that rooms without noise differ too.
Sample room(LidarOptions options, std::uint64_t seed) {
  constexpr double golden = 0.6180339887498949;
  options.first_azimuth = golden * static_cast<double>(seed - 1) - std::floor(golden * static_cast<double>(seed - 1));
  LidarOptions without_noise = options;
  without_noise.noise = 0;
  return {.cloud = shapes::lidar(options, seed), .truth = shapes::scanTruth(shapes::lidar(without_noise), true)};
}

/// The metrics of rooms. Marks apply at 0.1 and 0.2 degrees; coarser rooms are only reported.
std::vector<Metric> roomMetrics(const LidarOptions& options) {
  Mark components{.variant = "lidar"}, closed = components, area = components, wrong = components;
  const bool is_stretched = options.rings == 16 && options.azimuth_step < 0.15;
  if (options.azimuth_step < 0.3 && options.noise == 0) {
    components.rule = Rule::at_most, components.reference = Reference::yardstick, components.value = 4;
    closed.rule = Rule::at_least, closed.value = 0.96;
    area.rule = Rule::off_by_at_most, area.value = 0.045;
    wrong.rule = Rule::at_most, wrong.value = 1e-3;
    if (is_stretched) components.stretch = 1, closed.stretch = 0.98, area.stretch = 0.03;
  } else if (options.azimuth_step < 0.3) {
    components.rule = Rule::at_most, components.reference = Reference::core, components.value = 5;
    wrong.rule = Rule::at_most, wrong.value = 1.5e-3;
  }
  const auto inL = [](const Build& build) { return static_cast<double>(build.laplacian().report.components); };
  return {{"components", Format::count, inL, components, {"surfaces", surfacesOf}},
          {"components of surfaces", Format::count, componentsOfSurfaces, components, {"surfaces", surfacesOf}},
          {"closed inner stars", Format::percent, closedInnerStars, closed, {}},
          {"area", Format::signed_percent, gridAreaError, area, {}},
          {"wrong, across jumps", Format::percent, areaAcrossJumps, wrong, {}}};
}

/// The metrics that neighbours by pixels should improve, compared with the search of the core.
std::vector<Metric> imageMetrics() {
  const auto time = [](const Build& build) { return build.seconds() / build.core().seconds(); };
  const auto search = [](const Build& build) { return build.searchSeconds() / build.core().searchSeconds(); };
  const Mark none_across{.rule = Rule::at_most, .value = 0, .variant = "image"};
  return {{"across jumps", Format::count, trianglesAcrossJumps, none_across, {}},
          {"rows as the core's", Format::percent, equalRows, {}, {}},
          {"columns as the core's", Format::percent, equalColumns, {}, {}},
          {"search by the core's", Format::percent, search, {}, {}},
          {"time by the core's", Format::percent, time, {}, {}}};
}

/// A depth image of a camera at the origin.
Sample depthImage(const shapes::DepthCameraOptions& camera, std::uint64_t seed) {
  shapes::DepthCameraOptions exact = camera;
  exact.depth_step = exact.dropouts = 0;
  return {.cloud = shapes::depthCamera(camera, seed),
          .edges = shapes::imageEdges(shapes::depthCamera(exact)),
          .viewpoint = Eigen::Vector3d::Zero()};
}

std::vector<Metric> kindsOfTags() {
  const Mark tagged{.rule = Rule::at_least, .value = 0.95};
  std::vector<Metric> metrics;
  for (const Boundary kind : {Boundary::rim, Boundary::jump}) {
    const std::string name = kind == Boundary::rim ? "rims" : "jumps";
    const auto recall = [kind](const Build& build) { return imageRecall(build, kind); };
    const auto precision = [kind](const Build& build) { return imagePrecision(build, kind); };
    metrics.push_back({"recall of " + name, Format::percent, recall, tagged, {}});
    metrics.push_back({"precision of " + name, Format::percent, precision, tagged, {}});
  }
  return metrics;
}

std::vector<fs::path> filesIn(const fs::path& folder) {
  std::error_code absent;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, absent)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

Sample sampleOf(const fs::path& file) {
  Geometry geometry = read(file, ReadAs::cloud);
  Sample sample;
  sample.cloud.points = std::move(geometry.points);
  if (geometry.height > 1) sample.cloud.width = geometry.width, sample.cloud.height = geometry.height;
  return sample;
}

}  // namespace

void addRooms(bool is_quick, std::vector<Case>& cases) {
  for (const double noise : {0.0, 0.02}) {
    for (const int rings : {16, 32, 64}) {
      for (const double step : {0.1, 0.2, 0.4}) {
        if (is_quick && step < 0.15) continue;
        const LidarOptions options{.rings = rings, .azimuth_step = step, .noise = noise};
        char name[64];
        std::snprintf(name, sizeof name, "%d rings, %g deg, %g cm", rings, step, 100 * noise);
        cases.push_back({.what = "lidar",
                         .dataset = name,
                         .make = [options](std::uint64_t seed) { return room(options, seed); },
                         .metrics = roomMetrics(options)});
      }
    }
  }
}

void addDepthCamera(bool is_quick, std::vector<Case>& cases) {
  const shapes::DepthCameraOptions camera{.width = is_quick ? 320 : 640, .height = is_quick ? 240 : 480};
  std::vector<Metric> metrics = imageMetrics();
  for (Metric& metric : kindsOfTags()) metrics.push_back(std::move(metric));
  metrics.push_back({"mixed, by body", Format::percent, mixedBodies, {}, {}});
  cases.push_back({.what = "depth images",
                   .dataset = "room, " + std::to_string(camera.width) + " x " + std::to_string(camera.height),
                   .make = [camera](std::uint64_t seed) { return depthImage(camera, seed); },
                   .metrics = std::move(metrics)});
}

void addFiles(std::vector<Case>& cases) {
  for (const char* folder : {TUFTED_DATA_DIR "/clouds", TUFTED_CGAL_DATA_DIR "/points_3"}) {
    for (const fs::path& file : filesIn(folder)) {
      const bool is_image = sampleOf(file).cloud.height > 0;
      cases.push_back({.what = is_image ? "depth images" : "files",
                       .dataset = file.filename(),
                       .make = [file](std::uint64_t) { return sampleOf(file); },
                       .metrics = is_image ? imageMetrics() : std::vector<Metric>(),
                       .is_random = false});
    }
  }
}

std::vector<Case> scanCases(bool is_quick) {
  std::vector<Case> cases;
  addShapes(is_quick, cases);
  addRooms(is_quick, cases);
  addDepthCamera(is_quick, cases);
  addFiles(cases);
  for (Case& c : cases) {
    c.metrics.push_back({"build", Format::seconds, [](const Build& build) { return build.seconds(); }, {}, {}});
    c.metrics.push_back({"broken guarantees",
                         Format::count,
                         brokenPromises,
                         {.rule = Rule::at_most, .variant = "all", .at_any_size = true},
                         {}});
  }
  return cases;
}

}  // namespace tufted::bench
