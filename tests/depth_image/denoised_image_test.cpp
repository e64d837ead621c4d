// denoise() of depth images: along the rays, as a build moves points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "depth_image/image.h"
#include "shapes/random.h"
#include "support/refusal.h"
#include "tufted/denoise.h"

namespace tufted::denoised_image_test {
namespace {

using image_tests::height;
using image_tests::width;

/// A slanted plane with noise of the inverse depth.
Points noisyPlane(double noise, int seed = 1) {
  shapes::Random random(seed);
  return image_tests::imageOf([&](int column, int row) {
    return 1 / (1 / image_tests::planeDepth(column, row, 0.3, -0.2) + noise * random.normal());
  });
}

TEST(DenoisedImage, LiesWhereABuildMeasures) {
  const ScanStructure structure = imageStructure(width, height);
  for (const double scale : {1.0, 1000.0, 1e-3}) {
    const Points points = scale * noisyPlane(2e-3);
    const DenoisedPoints done = denoise(points, {.structure = &structure});
    const Laplacian laplacian = image_tests::imageLaplacian(points);
    EXPECT_EQ(done.positions, laplacian.positions);
    EXPECT_EQ(done.report.moved, laplacian.report.denoised);
    EXPECT_EQ(done.report.noise, laplacian.report.noise);
    EXPECT_GT(done.report.moved, 0.95 * width * height);
  }
}

TEST(DenoisedImage, SaysHowStrongTheNoiseIsAlongTheRays) {
  const ScanStructure structure = imageStructure(width, height);
  const double noise = 2e-3;
  const Points points = noisyPlane(noise);
  const DenoisedPoints done = denoise(points, {.structure = &structure});
  for (int i = 0; i < points.rows(); ++i) {
    if (done.noise[i] == 0) {
      EXPECT_EQ(done.positions.row(i), points.row(i));
      continue;
    }
    // Of the inverse depth, so times the squared depth, and more along an oblique ray.
    EXPECT_NEAR(done.noise[i], noise * points(i, 2) * points.row(i).norm(), 0.15 * noise * points.row(i).squaredNorm());
  }
}

TEST(DenoisedImage, OfExactPointsIsTheSameBitForBit) {
  const ScanStructure structure = imageStructure(width, height);
  const Points points = noisyPlane(0);
  const DenoisedPoints done = denoise(points, {.structure = &structure});
  EXPECT_EQ(done.positions, points);
  EXPECT_EQ(done.report.moved, 0);
  EXPECT_EQ(done.report.noise, 0);
}

TEST(DenoisedImage, TakesPointsAtTheSensor) {
  const ScanStructure structure = imageStructure(width, height);
  Points points = noisyPlane(2e-3);
  for (int i = 0; i < 6; ++i) points.row(25 * width + 20 + i) *= 1e-160;
  EXPECT_TRUE(denoise(points, {.structure = &structure}).positions.allFinite());
}

double rootMeanSquare(const Points& a, const Points& b) {
  return std::sqrt((a - b).squaredNorm() / static_cast<double>(a.rows()));
}

// Noise of ranges, which is alike near and far: where it was taken for that of disparities, points nearby stayed.
TEST(DenoisedImage, OfASensorThatTimesLightLosesItsNoiseNearAndFar) {
  const ScanStructure structure = imageStructure(width, height);
  const double noise = 5e-3;
  const auto depth = [](int, int row) { return 0.5 / (1 - 0.018 * row); };  // a floor from .5 to 4 m
  shapes::Random random(3);
  const Points surface = image_tests::imageOf(depth);
  const Points measured =
      image_tests::imageOf([&](int column, int row) { return depth(column, row) + noise * random.normal(); });
  const DenoisedPoints done = denoise(measured, {.structure = &structure});
  const auto errorOf = [&](const Points& points, int first_row, int rows) {
    return rootMeanSquare(points.middleRows(first_row * width, rows * width),
                          surface.middleRows(first_row * width, rows * width));
  };
  EXPECT_LT(errorOf(done.positions, 0, 10), 0.4 * errorOf(measured, 0, 10)) << "near";
  EXPECT_LT(errorOf(done.positions, 30, 10), 0.4 * errorOf(measured, 30, 10)) << "far";
}

/// A wall 1 m away with a relief all over it, and the same with white noise; lengths in deviations of that noise.
struct Relief {
  static constexpr int columns = 240, rows = 180;
  Points surface = Points(columns * rows, 3), measured = surface;

  Relief(double amplitude, double period) {
    shapes::Random random(7);
    constexpr double deviation = 2e-3, focal = 525;
    for (int i = 0; i < surface.rows(); ++i) {
      const double column = i % columns, row = i / columns, turn = 2 * M_PI / period;
      const Eigen::RowVector3d ray((column - columns / 2) / focal, (row - rows / 2) / focal, 1);
      const double depth = 1 + amplitude * deviation * std::sin(turn * column) * std::sin(turn * row);
      surface.row(i) = depth * ray;
      measured.row(i) = ray / (1 / depth + deviation * random.normal());
    }
  }
};

// A relief everywhere looks like noise of cameras, which goes on from pixel to pixel. But that is not white.
TEST(DenoisedImage, KeepsAReliefWhereNoiseIsWhite) {
  for (const auto& [amplitude, period] :
       {std::pair{2.0, 24.0}, {4.0, 24.0}, {8.0, 24.0}, {1.0, 40.0}, {2.0, 40.0}, {8.0, 40.0}, {1.0, 60.0}}) {
    const Relief relief(amplitude, period);
    const ScanStructure structure = imageStructure(Relief::columns, Relief::rows);
    const Points moved = denoise(relief.measured, {.structure = &structure}).positions;
    EXPECT_LT(rootMeanSquare(moved, relief.surface), 0.35 * rootMeanSquare(relief.measured, relief.surface))
        << amplitude << " deviations high, " << period << " pixels wide";
  }
}

// Noise that goes on from pixel to pixel is smoothed as widely as that of cameras.
TEST(DenoisedImage, LosesNoiseThatGoesOnAlongRowsOrColumns) {
  const Relief wall(0, 1);
  const ScanStructure structure = imageStructure(Relief::columns, Relief::rows);
  for (const int next : {1, Relief::columns}) {
    Points measured = wall.measured;
    for (int i = 0; i + next < measured.rows(); ++i)
      measured.row(i) *= 1 / (1 + 0.5 * (1 / wall.measured(i + next, 2) - 1) * measured(i, 2));
    const Points moved = denoise(measured, {.structure = &structure}).positions;
    EXPECT_LT(rootMeanSquare(moved, wall.surface), 0.05 * rootMeanSquare(measured, wall.surface)) << next;
  }
}

TEST(DenoisedImage, OfACoarseDepthWithoutNoiseLiesOnTheSurface) {
  // Steps are 16 columns apart, so that most rows of five pixels are exact.
  const ScanStructure structure = imageStructure(width, height);
  const double step = 0.016;
  const auto depth = [](int column, int row) { return image_tests::planeDepth(column, row, 0.1, -0.05); };
  const Points surface = image_tests::imageOf(depth);
  const Points coarse =
      image_tests::imageOf([&](int column, int row) { return 1 / (step * std::round(1 / depth(column, row) / step)); });
  const DenoisedPoints done = denoise(coarse, {.structure = &structure});
  EXPECT_LT(rootMeanSquare(done.positions, surface), 0.5 * rootMeanSquare(coarse, surface));
}

// Steps of one size are not those of a coarse depth where there is noise between them.
TEST(DenoisedImage, OfSlatsIsNoCoarseDepth) {
  const ScanStructure structure = imageStructure(width, height);
  shapes::Random random(1);
  const auto depth = [](int column, int) { return column / 16 % 2 == 0 ? 1 : 1.01; };
  const Points slats =
      image_tests::imageOf([&](int column, int row) { return 1 / (1 / depth(column, row) + 2e-4 * random.normal()); });
  EXPECT_LT(denoise(slats, {.structure = &structure}).report.noise, 4e-4);  // with the steps it would be 3e-3
}

TEST(DenoisedImage, HasTheSameBitsForAnyNumberOfThreads) {
  const ScanStructure structure = imageStructure(width, height);
  const Points points = noisyPlane(2e-3);
  const DenoisedPoints one = denoise(points, {.structure = &structure, .threads = 1});
  for (const int threads : {2, 3, 7}) {
    const DenoisedPoints done = denoise(points, {.structure = &structure, .threads = threads});
    EXPECT_EQ(done.positions, one.positions) << threads;
    EXPECT_EQ(done.noise, one.noise) << threads;
  }
}

TEST(DenoisedImage, LeavesPointsWithoutASurfaceWhereTheyAre) {
  Points points = noisyPlane(2e-3);
  points.row(7).setConstant(NAN);
  const int flying = 20 * width + 20, twice = flying + 7;
  points.row(flying) *= 0.5;
  points.row(twice) = points.row(twice + 1);
  ScanStructure structure = imageStructure(width, height);
  const int unplaced = flying + 20;
  structure.row[unplaced] = -1;
  const DenoisedPoints done = denoise(points, {.structure = &structure});
  for (const int i : {flying, unplaced}) EXPECT_EQ(done.positions.row(i), points.row(i)) << i;
  EXPECT_TRUE(done.positions.row(7).array().isNaN().all());
  EXPECT_EQ(done.positions.row(twice), done.positions.row(twice + 1));
  EXPECT_EQ(done.report.not_finite, 1);
  EXPECT_EQ(done.report.coincident, 1);
  EXPECT_EQ(done.report.unplaced, 1);
  EXPECT_EQ(done.report.outliers, 1);
}

TEST(DenoisedImage, OfNoPointsOrOneIsDefined) {
  for (const int few : {0, 1, 5}) {
    const ScanStructure structure = imageStructure(few, 1);
    const Points points = noisyPlane(2e-3).topRows(few);
    EXPECT_EQ(denoise(points, {.structure = &structure}).positions, points);
  }
}

TEST(DenoisedImage, RefusesAStructureThatIsNoneOfItsPoints) {
  const Points points = noisyPlane(0);
  ScanStructure structure = imageStructure(width, height - 1);
  const auto call = [&] { denoise(points, {.structure = &structure}); };
  EXPECT_EQ(support::refusal(call), "denoise: structure.row has 2940 entries, must have 3000, one per point");
  structure = imageStructure(width, height);
  structure.has_rings = true;
  EXPECT_EQ(support::refusal(call), "denoise: structure has rings, must be that of a depth image");
}

}  // namespace
}  // namespace tufted::denoised_image_test
