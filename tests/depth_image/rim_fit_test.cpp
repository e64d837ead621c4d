// The inverse depth at the rim of bodies that curve away from the sensor, where it goes like a root.
#include "depth_image/rim_fit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "depth_image/image.h"
#include "depth_image/range_fit.h"
#include "shapes/random.h"

namespace tufted::rim_fit_test {
namespace {

using namespace image_tests;

/// The part of a window where a surface is, with noise of 1.
struct Part {
  std::array<double, 49> values{};
  std::uint64_t around = 0;
  double truth;

  /// @param surface inverse depths by row and column, NaN where there is none
  Part(const std::function<double(int, int)>& surface, shapes::Random* random) : truth(surface(0, 0)) {
    const auto seen = [&](double value) { return value + (random == nullptr ? 0 : random->normal()); };
    values[24] = seen(truth);
    for (int i = 0; i < WindowPixels::count; ++i) {
      const PixelStep& step = window_pixels.step[i];
      const double value = surface(step.row, step.column);
      if (std::isnan(value)) continue;
      values[24 + 7 * step.row + step.column] = seen(value);
      around |= std::uint64_t{1} << i;
    }
  }

  PixelRows ranges() const { return {values.data() + 24, 7, 1}; }
};

const double down = std::cos(0.6), right = std::sin(0.6);  // across the rim, into the body

/// Rises with the root of the distance from a silhouette across which the middle lies `inside` pixels, by so many
/// deviations of noise in the first pixel; the silhouette runs aslant and bends.
std::function<double(int, int)> rimOf(double rise, double inside, double bend = 0) {
  return [=](int row, int column) {
    const double across = down * row + right * column, along = down * column - right * row;
    const double distance = inside + across + bend * along * along;
    return distance < 0 ? NAN : 1000 + 0.3 * along + rise * std::sqrt(distance);
  };
}

TEST(RimFit, FollowsARootToTheSilhouette) {
  for (const double inside : {0.2, 0.4, 0.7, 1.1, 1.6}) {
    for (const double bend : {0.0, -0.004, 0.004}) {
      const Part part(rimOf(20, inside, bend), nullptr);
      const auto fit = fitRim(part.ranges(), part.around, down, right, 1);
      ASSERT_TRUE(fit);
      EXPECT_NEAR(fit->value, part.truth, 0.4) << inside << " pixels inside, bend " << bend;
      EXPECT_LT(fit->misfits, 3);
      EXPECT_GT(fit->gap, -0.7);
      EXPECT_LT(fit->gap, 0.7);
    }
  }
}

TEST(RimFit, LeverageIsTheVarianceOfItsValue) {
  shapes::Random random(1);
  const auto rim = rimOf(20, 0.8);
  double squares = 0, leverage = 0;
  constexpr int samples = 2000;
  for (int i = 0; i < samples; ++i) {
    const Part part(rim, &random);
    const auto fit = fitRim(part.ranges(), part.around, down, right, 1);
    ASSERT_TRUE(fit);
    squares += std::pow(fit->value - part.truth, 2) / samples;
    leverage += fit->leverage / samples;
  }
  EXPECT_NEAR(squares, leverage, 0.2 * leverage);
}

/// Root mean square error of the smoothed middle.
double errorOf(const std::function<double(int, int)>& surface) {
  shapes::Random random(2);
  double squares = 0;
  constexpr int samples = 1000;
  for (int i = 0; i < samples; ++i) {
    const Part part(surface, &random);
    const auto range = smoothedInverseDepth(part.ranges(), part.around, {}, {}, 1);
    squares += std::pow(range.value_or(SmoothedRange{part.values[24], 0}).inverse - part.truth, 2) / samples;
  }
  return std::sqrt(squares);
}

TEST(SmoothedInverseDepth, HasHalfTheNoiseAtRims) {
  // Quadratics have errors of 1.33, 0.50 and 0.95 in the first case, of 0.78, 0.4 and 0.51 in the second.
  for (const double rise : {15.0, 7.0}) {
    EXPECT_LT(errorOf(rimOf(rise, 0.1)), 0.9);
    EXPECT_LT(errorOf(rimOf(rise, 0.5)), 0.5);
    EXPECT_LT(errorOf(rimOf(rise, 1.2)), 0.35);
  }
}

TEST(SmoothedInverseDepth, TakesNoFlatSurfaceForARim) {
  for (const double slope : {2.0, 6.0}) {
    const auto card = [slope](int row, int column) { return column < -1 ? NAN : 1000 + slope * column + 0.5 * row; };
    EXPECT_LT(errorOf(card), 0.45) << "a quadratic has 0.43";
  }
}

/// Root mean square error along the rays of the last pixels of a ball, in deviations of the noise of inverse depths.
TEST(ImageSmoothing, KeepsTheRimOfABall) {
  const double noise = 4e-3, radius = 100.3;
  const auto inside = [&](int column, int row) { return radius - std::hypot(column + 55.2, row - height / 2 + 0.4); };
  const auto ball = [&](int column, int row) {
    const double s = inside(column, row);
    return s < 0 ? NAN : 2 - std::sqrt(s * (2 * radius - s)) / 100;
  };
  double squares = 0;
  int count = 0;
  for (int seed = 1; seed <= 3; ++seed) {
    shapes::Random random(seed);
    const Points points = imageOf([&](int column, int row) {
      const double depth = ball(column, row);
      return 1 / (1 / depth + noise * random.normal());
    });
    const Laplacian laplacian = imageLaplacian(points);
    for (int i = 0; i < points.rows(); ++i) {
      const int column = i % width, row = i / width;
      if (!(inside(column, row) >= 0 && inside(column, row) < 2)) continue;
      squares += std::pow((1 / laplacian.positions(i, 2) - 1 / ball(column, row)) / noise, 2);
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.5) << "0.64 with quadratics";
}

}  // namespace
}  // namespace tufted::rim_fit_test
