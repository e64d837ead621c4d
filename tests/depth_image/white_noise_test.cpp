// Whether noise is white is told by the side of the surface on which neighbouring pixels lie.
#include "depth_image/white_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "shapes/random.h"

namespace tufted::white_noise_test {
namespace {

constexpr int columns = 120, rows = 90;
constexpr double deviation = 1e-3;

double surface(int row, int column) {
  return 1 + 4e-4 * row - 2.7e-4 * column + 5e-3 * std::sin(0.3 * column);
}

/// Of an image that measures such inverse depths of the surface, as if smoothing had found it. Values that are not
/// finite are missing.
bool changesSides(const std::function<double(int, int)>& measured) {
  PixelGrid grid;
  grid.rows = rows + 2 * PixelGrid::margin;
  grid.columns = columns + 2 * PixelGrid::margin;
  grid.origin.setZero();
  grid.axis = {0, 0, 1};
  grid.rank.assign(static_cast<std::size_t>(grid.rows) * grid.columns, -1);
  const Progress silent;
  const Workers workers(2, silent);
  SmoothedRanges smoothed;
  smoothed.clear(grid, workers);
  Points points(rows * columns, 3);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double inverse = measured(row, column);
      if (!std::isfinite(inverse)) continue;
      const int p = row * columns + column;
      points.row(p) << 0, 0, 1 / inverse;
      grid.rank[(row + PixelGrid::margin) * grid.columns + column + PixelGrid::margin] = p;
      const std::ptrdiff_t at = smoothed.at(row + PixelGrid::margin, column + PixelGrid::margin);
      smoothed.inverse[at] = surface(row, column);
      smoothed.variance[at] = 1;
    }
  }
  return changesSidesFreely(grid, points, smoothed, {deviation, 0}, workers);
}

std::vector<double> normals() {
  shapes::Random random(5);
  std::vector<double> all(static_cast<std::size_t>(rows) * (columns + 1) + columns);
  for (double& one : all) one = random.normal();
  return all;
}

TEST(WhiteNoise, ChangesSidesFreely) {
  const std::vector<double> noise = normals();
  EXPECT_TRUE(changesSides(
      [&](int row, int column) { return surface(row, column) + deviation * noise[row * columns + column]; }));
}

TEST(WhiteNoise, IsNoneThatGoesOnAlongRowsOrColumns) {
  const std::vector<double> noise = normals();
  for (const int next : {1, columns})
    EXPECT_FALSE(changesSides([&](int row, int column) {
      const int i = row * columns + column;
      return surface(row, column) + deviation * (noise[i] + 0.5 * noise[i + next]);
    }));
}

TEST(WhiteNoise, IsNotLeftByStepsOfACoarseDepth) {
  for (const double step : {1e-3, 5e-3})
    EXPECT_FALSE(changesSides([&](int row, int column) { return step * std::round(surface(row, column) / step); }))
        << step;
}

TEST(WhiteNoise, IsNotToldWithoutNeighbours) {
  const std::vector<double> noise = normals();
  EXPECT_FALSE(changesSides([&](int row, int column) {
    return (row + column) % 2 == 0 ? surface(row, column) + deviation * noise[row * columns + column] : NAN;
  }));
}

}  // namespace
}  // namespace tufted::white_noise_test
