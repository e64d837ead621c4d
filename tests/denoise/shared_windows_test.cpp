#include "denoise/shared_windows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "denoise/middle_windows.h"
#include "denoise/pooling.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/window_cloud.h"

namespace tufted::shared_windows_test {
namespace {

constexpr int count = 8000;
const double spacing = 1 / std::sqrt(count);

Points square() {
  return shapes::square(count, shapes::Sampling::uniform, shapes::Rim::included, 3).points;
}

/// Random heights on a grid, and in between the bilinear ones.
class GridNoise {
 public:
  GridNoise(double cell, shapes::Random& random) : cell_(cell), rows_(static_cast<int>(1 / cell) + 2) {
    heights_.resize(static_cast<std::size_t>(rows_) * rows_);
    for (double& height : heights_) height = random.normal();
  }
  double at(double x, double y) const {
    const double column = x / cell_, row = y / cell_, u = column - std::floor(column), v = row - std::floor(row);
    const auto height = [&](int right, int up) {
      return heights_[(static_cast<int>(row) + up) * rows_ + static_cast<int>(column) + right];
    };
    return (1 - v) * ((1 - u) * height(0, 0) + u * height(1, 0)) + v * ((1 - u) * height(0, 1) + u * height(1, 1));
  }

 private:
  double cell_;
  int rows_;
  std::vector<double> heights_;
};

/// Of the windows that were chosen to hold 64 neighbours, as the surface bends in wider ones, the share that a wider
/// one counts for.
double widenedShare(const Points& points) {
  support::WindowCloud cloud(points);
  const NoiseLevel noise = findNoise(WindowFitter(cloud.ranked.points, cloud.source, cloud.workers), cloud.workers,
                                     cloud.windows, cloud.lists);
  fitThroughMiddles(cloud.ranked.points, cloud.workers, cloud.windows);
  const WindowChoice choice = chooseWindows(cloud.windows, noise, allOf(cloud.windows), cloud.workers);
  const Buffer<std::int8_t> shared = sharedWindows(cloud.windows, noise, choice, cloud.workers);
  int bends = 0, widened = 0;
  for (int w = 0; w < cloud.windows.size(); ++w) {
    if (choice.biased[w] == 0 || choice.window[w] != 2) continue;
    ++bends;
    widened += shared[w] == 3 ? 1 : 0;
  }
  EXPECT_GT(bends, 100);
  return widened / static_cast<double>(bends);
}

TEST(SharedWindows, AreWiderWhereNoiseIsAlikeInNeighbouringPoints) {
  Points points = square();
  shapes::Random random(5);
  for (const double cell : {1.5, 2.1, 3.0, 4.2, 6.0, 8.5, 12.0, 17.0, 24.0}) {
    const GridNoise noise(cell * spacing, random);
    for (int i = 0; i < count; ++i) points(i, 2) += 0.15 * spacing * noise.at(points(i, 0), points(i, 1));
  }
  for (int i = 0; i < count; ++i) points(i, 2) += 0.15 * spacing * random.normal();
  EXPECT_GT(widenedShare(points), 0.25);
}

TEST(SharedWindows, AreNoWiderOnWaves) {
  for (const auto& [length, noise] : {std::pair(8.0, 0.36), std::pair(12.0, 0.18), std::pair(16.0, 0.18)}) {
    Points points = square();
    shapes::Random random(7);
    const double turn = 2 * std::numbers::pi / (length * spacing);
    for (int i = 0; i < count; ++i) {
      const double wave = std::sin(turn * points(i, 0)) * std::sin(turn * points(i, 1));
      points(i, 2) = spacing * (0.5 * wave + noise * random.normal());
    }
    EXPECT_LT(widenedShare(points), 0.06) << length;
  }
}

}  // namespace
}  // namespace tufted::shared_windows_test
