// The noise of depth images, and how ranges get rid of it.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "depth_image/image.h"
#include "depth_image/pixel_frame.h"
#include "depth_image/range_fit.h"
#include "shapes/random.h"
#include "simd/kernels.h"
#include "tufted/laplacian.h"

namespace tufted::smoothing_test {
namespace {

using namespace image_tests;

/// Depths with noise of the inverse depth.
Points noisy(const std::function<double(int, int)>& depth, double noise, int seed) {
  shapes::Random random(seed);
  return imageOf([&](int column, int row) { return 1 / (1 / depth(column, row) + noise * random.normal()); });
}

/// In units of the caller.
RangeNoise lawOf(const Points& points) {
  const Image image(points);
  const Progress silent;
  const RangeNoise noise = rangeNoise(image.grid(), image.cloud().points, Workers(2, silent));
  return {std::ldexp(noise.of_inverse, -image.cloud().exponent), std::ldexp(noise.of_depth, image.cloud().exponent)};
}

double noiseOf(const Points& points) {
  const RangeNoise noise = lawOf(points);
  EXPECT_EQ(noise.of_depth, 0);
  return noise.of_inverse;
}

double slanted(int column, int row) {
  return planeDepth(column, row, 0.3, -0.2);
}

double ball(int column, int row) {
  const double u = (column - width / 2) / 100.0, v = (row - height / 2) / 100.0;
  return 2 - std::sqrt(1 - u * u - v * v);
}

TEST(RangeNoise, IsFoundOnSurfacesOfAnyShape) {
  for (const auto& depth : {slanted, ball})
    for (const double noise : {1e-4, 1e-3, 1e-2}) EXPECT_NEAR(noiseOf(noisy(depth, noise, 1)), noise, 0.1 * noise);
}

TEST(RangeNoise, IsNotCurvature) {
  for (const auto& depth : {slanted, ball}) EXPECT_LT(noiseOf(imageOf(depth)), 1e-7);
}

/// A floor from 1 to 5 m.
double floorDepth(int, int row) {
  return 1 / (1 - 0.016 * row);
}

/// The floor with noise of the range that grows with a power of it.
Points noisyFloor(double noise, double power, int seed) {
  shapes::Random random(seed);
  return imageOf([&](int column, int row) {
    const double depth = floorDepth(column, row);
    return depth + noise * std::pow(depth, power) * random.normal();
  });
}

TEST(RangeNoise, OfASensorThatTimesLightIsThatOfRanges) {
  for (int seed = 1; seed <= 3; ++seed) {
    const RangeNoise timed = lawOf(noisyFloor(2e-3, 0, seed));
    EXPECT_NEAR(timed.of_depth, 2e-3, 2e-4) << seed;
    EXPECT_LT(timed.of_inverse, 2e-5) << seed;
    const RangeNoise disparities = lawOf(noisyFloor(2e-3, 2, seed));
    EXPECT_NEAR(disparities.of_inverse, 2e-3, 2e-4) << seed;
    EXPECT_EQ(disparities.of_depth, 0) << seed;
  }
}

TEST(RangeNoise, ThatGrowsWithTheRangeIsASumOfBothLaws) {
  for (int seed = 1; seed <= 3; ++seed) {
    const RangeNoise noise = lawOf(noisyFloor(2e-3, 1, seed));
    for (const double range : {1.2, 2.0, 4.0})
      EXPECT_NEAR(noise.atRange(range, range), 2e-3 * range, 7e-4 * range) << seed;
  }
}

TEST(RangeNoise, OfACoarseDepthIsThatOfInverseRanges) {
  const double step = 0.004;
  const Points coarse = imageOf(
      [&](int column, int row) { return 1 / (step * std::round(1 / floorDepth(column, row + column / 20) / step)); });
  EXPECT_EQ(lawOf(coarse).of_depth, 0);
}

TEST(RangeNoise, IsNotJumps) {
  const auto stripes = [](int column, int row) { return column % 12 < 6 ? slanted(column, row) : 1.5; };
  EXPECT_NEAR(noiseOf(noisy(stripes, 1e-3, 2)), 1e-3, 2e-4);
  EXPECT_EQ(noiseOf(Points::Constant(width * height, 3, std::nan(""))), 0);
}

TEST(SmoothedInverseDepth, KeepsQuadraticsAndTakesTheRest) {
  std::array<double, 49 + kernel_packet> values{};
  const auto fill = [&](double cubic) {
    for (int i = -3; i <= 3; ++i)
      for (int j = -3; j <= 3; ++j)
        values[(i + 3) * 7 + j + 3] =
            1 + 0.1 * i - 0.2 * j + 0.03 * i * j + 0.02 * i * i - 0.01 * j * j + cubic * (i * i * i + j);
  };
  fill(0);
  values[24] += 0.01;  // the noise of the middle
  const PixelRows ranges{values.data() + 24, 7, 1};
  const auto smoothedOf = [&](std::uint64_t around) {
    SquareFits narrow, wide;
    kernels().fitSquares5(ranges, narrow);
    kernels().fitSquares7(ranges, wide);
    return smoothedInverseDepth(ranges, around, {narrow.value[0], narrow.variance[0]},
                                {wide.value[0], wide.variance[0]}, 0.01, 1e-6);
  };
  const auto smoothed = smoothedOf(WindowPixels::rings(3));
  ASSERT_TRUE(smoothed);
  EXPECT_NEAR(smoothed->inverse, 1, 0.01 * 0.16);  // its own weight
  EXPECT_FALSE(smoothedOf(0xF)) << "few pixels";
  EXPECT_TRUE(needsSmoothing(1, 0.01, 1e-6));
  EXPECT_FALSE(needsSmoothing(1, 0.01, 1e6)) << "far less than the spacing";
  EXPECT_FALSE(needsSmoothing(1e9, 0.01, 1e-6)) << "rounding";
}

/// The left half of a window, of a surface that is 2 in the middle, with waves across it of 1e-3.
struct HalfWindow {
  std::array<double, 49> values{};
  std::uint64_t around = 0;

  explicit HalfWindow(const std::function<double(int, int)>& rise) {
    for (int i = 0; i < WindowPixels::count; ++i) {
      const auto [row, column] = window_pixels.step[i];
      if (column > 0) continue;
      values[24 + 7 * row + column] = 2 + rise(row, column) + (row % 2 == 0 ? 1e-3 : -1e-3);
      around |= std::uint64_t{1} << i;
    }
    values[24] = 2 + 1e-3;
  }

  std::optional<SmoothedRange> smoothed(double noise, double spacing_squared = 1e-6) const {
    return smoothedInverseDepth({values.data() + 24, 7, 1}, around, {}, {}, noise, spacing_squared);
  }

  /// A plane, by the normal equations of all 28 pixels.
  SmoothedRange plane() const {
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (int row = -3; row <= 3; ++row) {
      for (int column = -3; column <= 0; ++column) {
        const Eigen::Vector3d base(1, row, column);
        moments += base * base.transpose();
        right += values[24 + 7 * row + column] * base;
      }
    }
    return {moments.ldlt().solve(right)[0], moments.ldlt().solve(Eigen::Vector3d::UnitX())[0] * 1e-6};
  }
};

TEST(SmoothedInverseDepth, AtEdgesIsThatOfAPlane) {
  const HalfWindow window([](int row, int column) { return 1e-4 * row - 3e-4 * column; });
  const auto smoothed = window.smoothed(1e-3);
  ASSERT_TRUE(smoothed);
  EXPECT_NEAR(smoothed->inverse, window.plane().inverse, 1e-13);
  EXPECT_NEAR(smoothed->variance, window.plane().variance, 0.35 * window.plane().variance);
  EXPECT_FALSE(window.smoothed(1e-4)) << "more than noise";
}

TEST(SmoothedInverseDepth, AtEdgesStaysWhereTheSurfaceIsSteepByNoiseAndBySpacing) {
  const HalfWindow window([](int row, int column) { return 1e-3 * row - 3e-3 * column; });
  EXPECT_FALSE(window.smoothed(1e-3));
  EXPECT_TRUE(window.smoothed(1e-2)) << "noise makes planes as steep";
  EXPECT_TRUE(window.smoothed(1e-3, 1e-5)) << "seen at 45 degrees";
}

double distanceFrom(const Points& points, const std::function<double(int, int)>& depth) {
  double squares = 0;
  for (int i = 0; i < points.rows(); ++i)
    squares += std::pow(points(i, 2) / depth(i % width, i / width) - 1, 2) / static_cast<double>(points.rows());
  return std::sqrt(squares);
}

/// A plane at the rim, which curves away from the sensor, would leave it off by a fraction of the noise.
TEST(ImageSmoothing, LeavesTheRimOfABallWhereItIs) {
  const double noise = 4e-3, radius = 100.3;
  const auto inside = [&](int column, int row) { return radius - std::hypot(column + 55.2, row - height / 2 + 0.4); };
  const auto rim = [&](int column, int row) {
    const double s = inside(column, row);
    return s < 0 ? NAN : 2 - std::sqrt(s * (2 * radius - s)) / 100;
  };
  double sum = 0;
  int count = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    const Points points = noisy(rim, noise, seed);
    const Laplacian laplacian = imageLaplacian(points);
    for (int i = 0; i < points.rows(); ++i) {
      const int column = i % width, row = i / width;
      if (!(inside(column, row) >= 0 && inside(column, row) < 2)) continue;
      sum += (1 / laplacian.positions(i, 2) - 1 / rim(column, row)) / noise;
      ++count;
    }
  }
  EXPECT_LT(std::abs(sum / count), 0.1) << count << " pixels";
}

TEST(ImageSmoothing, BringsPointsToTheSurfaceAlongTheirRays) {
  for (const auto& depth : {slanted, ball}) {
    for (const double noise : {1e-3, 1e-2}) {
      const Points points = noisy(depth, noise, 3);
      const Laplacian laplacian = imageLaplacian(points);
      EXPECT_GT(laplacian.report.denoised, 0.95 * width * height);
      EXPECT_LT(distanceFrom(laplacian.positions, depth), (noise > 5e-3 ? 0.35 : 0.45) * distanceFrom(points, depth));
      for (int i = 0; i < points.rows(); ++i) {
        const Eigen::RowVector3d before = points.row(i).normalized(), after = laplacian.positions.row(i).normalized();
        ASSERT_LT((before - after).norm(), 1e-14);
      }
    }
  }
}

TEST(ImageSmoothing, LeavesExactPointsBitForBit) {
  for (const auto& depth : {slanted, ball}) {
    const Points points = imageOf(depth);
    const Laplacian laplacian = imageLaplacian(points);
    EXPECT_EQ(laplacian.report.denoised, 0);
    EXPECT_EQ(laplacian.positions, points);
  }
}

TEST(PixelFrame, IsExactOnPlanesAndFacesTheSensor) {
  const Points points = imageOf([](int column, int row) { return planeDepth(column, row, 0.7, -0.4); });
  const Image image(points);
  const Eigen::Vector3d normal = Eigen::Vector3d(-0.7, 0.4, 1).normalized();  // 1 / z = 1 - 0.7 u + 0.4 v
  PixelWindow window;
  for (int p = 0; p < image.cloud().size(); ++p) {
    window.take(image.view(), p, 2);
    const auto frame = fitFrame(image.view(), window, p);
    ASSERT_TRUE(frame);
    EXPECT_LT(frame->normal.dot(points.row(image.pointOf(p))), 0);
    EXPECT_NEAR(std::abs(frame->normal.dot(normal)), 1, 1e-12);
  }
}

TEST(PixelFrame, OfPixelsOnOneLineIsNone) {
  const Image image(
      imageOf([](int column, int row) { return row == 7 ? planeDepth(column, row, 0.1, 0) : std::nan(""); }));
  PixelWindow window;
  for (int p = 0; p < image.cloud().size(); ++p) {
    window.take(image.view(), p, 3);
    EXPECT_FALSE(fitFrame(image.view(), window, p));
  }
}

TEST(PixelFrame, IsNotTurnedByNoiseLargerThanThePixels) {
  // Noise of 2 pixels along the sight: principal axes of 25 points would point anywhere.
  const Points points = noisy(slanted, 0.02, 4);
  const Image image(points, 0.02 * std::ldexp(1.0, Image(points).cloud().exponent), true);
  const Eigen::Vector3d normal = Eigen::Vector3d(-0.3, 0.2, 1).normalized();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  PixelWindow window;
  for (int p = 0; p < image.cloud().size(); ++p) {
    window.take(image.view(), p, 2);
    if (const auto frame = fitFrame(image.view(), window, p)) mean += frame->normal;
  }
  EXPECT_GT(std::abs(mean.normalized().dot(normal)), std::cos(0.05));
}

}  // namespace
}  // namespace tufted::smoothing_test
