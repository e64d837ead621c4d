#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/costs.h"
#include "bench/search_stage.h"
#include "neighbors/morton.h"
#include "shapes/shapes.h"
#include "simd/kernels.h"
#include "tufted/laplacian.h"
#ifdef TUFTED_BENCH_IO
#include "tufted/io/read.h"
#endif

namespace tufted::bench {
namespace {

constexpr int neighbor_count = 30;
constexpr double noise = 0.005;  // standard deviation, in radii of the sphere

struct CloudCase {
  std::string cloud;  ///< name of the cloud
  std::function<Points()> make;
  Preset preset = Preset::clean;
  int threads = 1;
  bool portable = false;  ///< whether to use the kernels without AVX

  std::string name() const {
    return "cloud/" + cloud + "/" +
           (preset == Preset::clean  ? "clean"
            : preset == Preset::scan ? "scan"
                                     : "lidar") +
           (portable ? "/portable" : "") + "/" + threadsName(threads);
  }
};

/// The points of a case. Those of the last case are kept.
const Points& pointsOf(const CloudCase& c) {
  static std::string cloud;
  static Points points;
  if (cloud != c.cloud) points = c.make();
  cloud = c.cloud;
  return points;
}

RankedCloud ranked(const Points& points) {
  std::vector<PointStatus> status;
  std::vector<int> representative;
  return rankPoints(points, status, representative);
}

/// One build per iteration, in CPU time on one thread, otherwise in wall-clock time. On one thread each build is
/// followed by a search (not timed), so that both medians are from the same minutes: `whole_per_flann`. Points that are
/// counted are finite and distinct. The cover is not kept; three more builds measure building it on demand:
/// `cover_per_whole`.
void runCloud(benchmark::State& state, const CloudCase& c) {
  const Points& points = pointsOf(c);
  CloudOptions options = cloudOptions(c.preset);
  options.neighbors = neighbor_count;
  options.threads = c.threads;
  options.keep_cover = false;
  chooseKernels(c.portable ? &portableKernels() : nullptr);
  Costs costs(ranked(points).size());  // the ranked points are not kept, as they would count in the peak
  if (c.threads == 1) costs.measurePeak([&] { pointCloudLaplacian(points, options); });
  pointCloudLaplacian(points, options);  // the first build is not measured, because it takes memory from the system
  const RankedCloud cloud = ranked(points);
  for ([[maybe_unused]] auto _ : state) {
    {
      const BuildStopwatch watch(c.threads);
      const Laplacian laplacian = pointCloudLaplacian(points, options);
      const double seconds = watch.seconds();
      state.SetIterationTime(seconds);
      costs.addBuild(seconds, laplacian.report);
    }
    if (c.threads != 1) continue;
    costs.addSeconds("flann", searchSeconds(cloud.points, neighbor_count));
  }
  costs.publish(state);
  const double whole = costs.medianSeconds("whole");
  state.counters["frames_per_second"] = 1 / whole;
  if (c.threads != 1) return;
  state.counters["whole_per_flann"] = whole / costs.medianSeconds("flann");
  options.keep_cover = true;
  for (int i = 0; i < 3; ++i) {
    const Laplacian laplacian = pointCloudLaplacian(points, options);
    const CpuStopwatch watch;
    benchmark::DoNotOptimize(laplacian.cover().length.data());
    costs.addSeconds("whole_cover", watch.seconds());
  }
  state.counters["cover_per_whole"] = costs.medianSeconds("whole_cover") / whole;
}

void registerCloud(const CloudCase& c, std::int64_t points) {
  benchmark::RegisterBenchmark(c.name().c_str(), [c](benchmark::State& state) { runCloud(state, c); })
      ->UseManualTime()
      ->Iterations(iterationsFor(points))
      ->Unit(benchmark::kMillisecond);
}

/// Registers a case with one and with all threads, clean and scan.
void registerPresets(CloudCase c, std::int64_t points) {
  for (const int threads : {1, 0}) {
    for (const Preset preset : {Preset::clean, Preset::scan}) {
      c.preset = preset;
      c.threads = threads;
      registerCloud(c, points);
    }
  }
}

std::string counted(const std::string& name, int points) {
  return name + "/" + std::to_string(points);
}

void registerSpheres() {
  for (const int n : {10'000, 30'000, 100'000, 1'000'000, 5'000'000}) {
    // Random points in random order, and in the order of a scan.
    CloudCase sphere{.cloud = counted("sphere", n), .make = [n] { return shapes::sphere(n).points; }};
    registerPresets(sphere, n);
    if (n > 1'000'000) continue;
    registerPresets({.cloud = counted("sphere_in_order", n),
                     .make = [n]() -> Points { return ranked(shapes::sphere(n).points).points.all(); }},
                    n);
    registerPresets({.cloud = counted("noisy_sphere", n),
                     .make = [n] { return shapes::withNoise(shapes::sphere(n), noise).points; }},
                    n);
    sphere.portable = true;
    registerCloud(sphere, n);
  }
}

void registerScans() {
  registerPresets({.cloud = "depth_camera/640x480", .make = [] { return shapes::depthCamera().points; }}, 640 * 480);
  for (const int rings : {16, 64}) {
    CloudCase lidar{.cloud = counted("lidar_rings", rings),
                    .make = [rings] { return shapes::lidar({.rings = rings, .azimuth_step = 0.2}).points; },
                    .preset = Preset::lidar};
    for (const int threads : {1, 0}) {
      lidar.threads = threads;
      registerCloud(lidar, rings * 1800);
    }
  }
#ifdef TUFTED_BENCH_IO
  if (!std::filesystem::is_directory(TUFTED_DATA_DIR "/clouds")) return;
  for (const auto& file : std::filesystem::directory_iterator(TUFTED_DATA_DIR "/clouds"))
    registerPresets(
        {.cloud = "file/" + file.path().stem().string(), .make = [file] { return read(file.path()).points; }}, 200'000);
#endif
}

}  // namespace

void registerClouds() {
  registerSpheres();
  registerScans();
}

}  // namespace tufted::bench
