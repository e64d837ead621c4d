// Depth images in which single pixels are missing.
#include "depth_image/missing_pixels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "shapes/random.h"
#include "tufted/denoise.h"
#include "tufted/scan_structure.h"

namespace tufted::missing_pixels_test {
namespace {

TEST(MissingPixels, AmongRingsStayMissing) {
  const Progress silent;
  const Workers workers(1, silent);
  PixelGrid grid;
  grid.rows = grid.columns = 3 + 2 * PixelGrid::margin;
  grid.rank.assign(static_cast<std::size_t>(grid.rows * grid.columns), 0);
  const int middle = PixelGrid::margin + 1;
  grid.rank[middle * grid.columns + middle] = -1;
  SmoothedRanges smoothed;
  smoothed.clear(grid, workers);
  for (const auto& [row, column] : {std::pair{0, -1}, {0, 1}, {-1, 0}, {1, 0}})
    smoothed.inverse[smoothed.at(middle + row, middle + column)] = 1;
  for (const bool goes_round : {true, false}) {
    grid.goes_round = goes_round;
    fillMissingPixels(grid, {1e-3, 0}, workers, smoothed);
    EXPECT_EQ(std::isnan(smoothed.inverse[smoothed.at(middle, middle)]), goes_round);
  }
}

/// Root mean square errors on a ball of radius .5 at 2 m and on the wall behind it at 3 m, with noise that grows with
/// the square of the range, after denoise().
std::array<double, 2> errors(double missing, int seed) {
  constexpr int width = 320, height = 240;
  constexpr double focal = 300;
  shapes::Random random(seed);
  Points points(width * height, 3), surface(width * height, 3);
  for (int i = 0; i < width * height; ++i) {
    const Eigen::RowVector3d ray((i % width - width / 2) / focal, (i / width - height / 2) / focal, 1);
    const double squares = ray.squaredNorm(), inside = 4 - squares * (4 - 0.25);
    const double depth = inside > 0 ? (2 - std::sqrt(inside)) / squares : 3;
    surface.row(i) = depth * ray;
    points.row(i) = (depth + 5e-4 * depth * depth * random.normal()) * ray;
    if (random.uniform() < missing) points.row(i).setConstant(std::nan(""));
  }
  const ScanStructure structure = imageStructure(width, height);
  const Points moved = denoise(points, {.structure = &structure}).positions;
  std::array<double, 2> squares{}, count{};
  for (int i = 0; i < width * height; ++i) {
    if (std::isnan(points(i, 0))) continue;
    const int body = surface(i, 2) < 3 ? 0 : 1;
    squares[body] += (moved.row(i) - surface.row(i)).squaredNorm();
    ++count[body];
  }
  return {std::sqrt(squares[0] / count[0]), std::sqrt(squares[1] / count[1])};
}

TEST(MissingPixels, LeaveTheRestSmooth) {
  for (const double missing : {0.0, 0.05, 0.2}) {
    const std::array<double, 2> error = errors(missing, 1);
    EXPECT_LT(error[0], 0.5 * 5e-4 * 4) << missing << ": half of the noise of the ball";
    EXPECT_LT(error[1], 0.1 * 5e-4 * 9) << missing << ": a tenth of that of the wall";
  }
}

}  // namespace
}  // namespace tufted::missing_pixels_test
