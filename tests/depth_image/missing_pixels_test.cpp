// Depth images in which single pixels are missing.
#include "depth_image/missing_pixels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "shapes/random.h"
#include "tufted/denoise.h"
#include "tufted/scan_structure.h"

namespace tufted::missing_pixels_test {
namespace {

constexpr double noise = 1e-3;

/// Smoothed ranges of a slanted plane, half of which lies behind a jump; some pixels of it have no point.
struct Case {
  static constexpr int width = 40, height = 30, jump = 20;

  PixelGrid grid;
  SmoothedRanges smoothed;

  explicit Case(const Workers& workers) {
    grid.rows = height + 2 * PixelGrid::margin;
    grid.columns = width + 2 * PixelGrid::margin;
    grid.rank.assign(static_cast<std::size_t>(grid.rows * grid.columns), -1);
    smoothed.clear(grid, workers);
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < width; ++column)
        if (!isMissing(row, column)) put(row, column);
  }

  static bool isMissing(int row, int column) {
    const bool is_hole = row >= 12 && row < 15 && column >= 5 && column < 8;
    return is_hole || (row % 4 == 2 && column % 5 == 4);
  }
  static double surface(int row, int column) { return (column < jump ? 1 : 2) + 1e-4 * row - 2e-4 * column; }

  std::ptrdiff_t at(int row, int column) const {
    return smoothed.at(row + PixelGrid::margin, column + PixelGrid::margin);
  }
  void put(int row, int column) {
    grid.rank[(row + PixelGrid::margin) * grid.columns + column + PixelGrid::margin] = row * width + column;
    smoothed.inverse[at(row, column)] = surface(row, column);
    smoothed.variance[at(row, column)] = noise * noise;
    smoothed.spacing_squared[at(row, column)] = 1e-8;
  }
};

TEST(MissingPixels, AreFilledByTheirSurface) {
  const Progress silent;
  for (const int threads : {1, 3}) {
    const Workers workers(threads, silent);
    Case image(workers);
    fillMissingPixels(image.grid, {noise, 0}, workers, image.smoothed);
    for (int row = 0; row < Case::height; ++row) {
      for (int column = 0; column < Case::width; ++column) {
        const double value = image.smoothed.inverse[image.at(row, column)];
        if (row == 13 && column == 6) {
          EXPECT_TRUE(std::isnan(value)) << "no point on either side";
        } else if (Case::isMissing(row, column) && (row < 12 || row > 14)) {
          EXPECT_NEAR(value, Case::surface(row, column), 1e-15) << row << ' ' << column;
          EXPECT_EQ(image.smoothed.variance[image.at(row, column)], 0) << "is no point";
        } else if (!Case::isMissing(row, column)) {
          EXPECT_EQ(value, Case::surface(row, column));
        }
      }
    }
    EXPECT_TRUE(std::isnan(image.smoothed.inverse[image.at(0, -1)])) << "beyond the image";
  }
}

TEST(MissingPixels, AmongRingsStayMissing) {
  const Progress silent;
  const Workers workers(1, silent);
  Case image(workers);
  image.grid.goes_round = true;
  fillMissingPixels(image.grid, {noise, 0}, workers, image.smoothed);
  EXPECT_TRUE(std::isnan(image.smoothed.inverse[image.at(2, 4)]));
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
