// Time of a build from a depth image or from rings, stage by stage, compared with a build by the tree and with PCL's
// normals.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/stage_clock.h"
#include "bench/pcl_rivals.h"
#include "bench/tables.h"
#include "shapes/shapes.h"
#include "tufted/io/read.h"
#include "tufted/laplacian_builder.h"

namespace tufted::bench {
namespace {

constexpr int frames = 9;

struct Image {
  std::string name;
  Points points;
  int width, height;
  bool has_rings = false;

  /// The preset for this kind of scan.
  Preset preset() const { return has_rings ? Preset::lidar : Preset::scan; }
  ScanStructure structure() const {
    if (!has_rings) return imageStructure(width, height);
    std::vector<int> ring;
    for (int i = 0; i < width * height; ++i) ring.push_back(i / width);
    return ringStructure(points, std::move(ring));
  }
  double finite() const { return static_cast<double>((points.rowwise().sum().array().isFinite()).count()); }
};

std::vector<Image> images() {
  std::vector<Image> images;
  const std::filesystem::path folder = std::filesystem::path(TUFTED_DATA_DIR) / "clouds";
  for (const char* name : {"mosd_learn0", "mosd_learn1", "milk_cartoon_all_small_clorox", "five_people", "office1"}) {
    const auto path = folder / (std::string(name) + ".pcd");
    if (!std::filesystem::exists(path)) continue;
    const Geometry geometry = read(path);
    images.push_back({name, geometry.points, geometry.width, geometry.height});
  }
  const shapes::Cloud camera = shapes::depthCamera({}, 101);
  images.push_back({"simulated room", camera.points, camera.width, camera.height});
  for (const int rings : {16, 64}) {
    const shapes::Cloud room = shapes::lidar({.rings = rings, .azimuth_step = 0.2, .noise = 0.02}, 101);
    images.push_back({"room, " + std::to_string(rings) + " rings", room.points, room.width, room.height, true});
  }
  return images;
}

/// The report and the seconds of the fastest of several frames of one builder.
struct Frame {
  Report report;
  double seconds = HUGE_VAL;
};

Frame fastestFrame(const Image& image, bool by_structure, int threads) {
  const ScanStructure structure = image.structure();
  CloudOptions options = by_structure ? cloudOptions(image.preset()) : CloudOptions();
  options.threads = threads;
  options.keep_cover = false;
  if (by_structure) options.structure = &structure;
  LaplacianBuilder builder;
  Frame fastest;
  for (int i = 0; i < frames; ++i) {
    const Stopwatch watch;
    const Laplacian& laplacian = builder.pointCloud(image.points, options);
    const double seconds = watch.seconds();
    if (seconds < fastest.seconds) fastest = {laplacian.report, seconds};
  }
  return fastest;
}

}  // namespace

void printDepthImageSpeed() {
  std::printf(
      "| image, points | by | us per point, one thread: stages | in all | frames a second, one and two threads | "
      "us: pcl::NormalEstimation, IntegralImageNormalEstimation |\n|---|---|---|---|---|---|\n");
  for (const Image& image : images()) {
    const double us = 1e6 / image.finite();
#ifdef TUFTED_BENCH_PCL
    const NormalSeconds pcl = image.has_rings ? pclNormalSeconds(image.points, image.width * image.height, 1)
                                              : pclNormalSeconds(image.points, image.width, image.height);
#else
    const NormalSeconds pcl{NAN, NAN};
#endif
    for (const bool by_structure : {false, true}) {
      const Frame one = fastestFrame(image, by_structure, 1), two = fastestFrame(image, by_structure, 2);
      std::string stages;
      for (const StageCost& stage : one.report.stages) {
        char text[80];
        std::snprintf(text, sizeof text, "%s%s %.2f", stages.empty() ? "" : ", ", stage.name.c_str(),
                      us * stage.seconds);
        if (us * stage.seconds >= 0.005) stages += text;
      }
      std::printf("| %s, %.0f | %s | %s | %.2f | %.1f, %.1f | %.2f, %.2f |\n", image.name.c_str(), image.finite(),
                  !by_structure     ? "tree"
                  : image.has_rings ? "rings"
                                    : "pixels",
                  stages.c_str(), us * one.seconds, 1 / one.seconds, 1 / two.seconds, us * pcl.by_neighbors,
                  us * pcl.by_integrals);
      std::fflush(stdout);
    }
  }
}

}  // namespace tufted::bench
