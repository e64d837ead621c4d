#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>

#include "bench/costs.h"
#include "tufted/view/picture.h"

namespace tufted::bench {

namespace {

/// Random points of the unit sphere, with their heights as a field.
Scene sphere(int points, bool has_normals) {
  std::mt19937_64 generator(101);
  const auto uniform = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  Scene scene = {.title = "sphere", .positions = Points(points, 3)};
  for (int i = 0; i < points; ++i) {
    const double z = 2 * uniform() - 1;
    const double angle = 2 * std::numbers::pi * uniform();
    const double r = std::sqrt(1 - z * z);
    scene.positions.row(i) << r * std::cos(angle), r * std::sin(angle), z;
  }
  if (has_normals) scene.normals = scene.positions;
  scene.fields = {{"z", FieldKind::distance, scene.positions.col(2)}};
  return scene;
}

}  // namespace

void registerPictures() {
  for (const int points : {100'000, 1'000'000})
    for (const bool has_normals : {false, true})
      benchmark::RegisterBenchmark(
          ("picture/sphere/" + std::to_string(points) + (has_normals ? "/normals" : "")).c_str(),
          [points, has_normals](benchmark::State& state) {
            const Scene scene = sphere(points, has_normals);
            const std::filesystem::path file =
                std::filesystem::temp_directory_path() / ("tufted-" + std::to_string(::getpid()) + ".png");
            for (auto _ : state) writePicture(file, scene);
            std::filesystem::remove(file);
          })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
}

}  // namespace tufted::bench
