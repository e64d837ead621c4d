#include "denoise/middle_windows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "denoise/noise_level.h"
#include "denoise/pooling.h"
#include "shapes/shapes.h"
#include "support/window_cloud.h"

namespace tufted::middle_windows_test {
namespace {

using shapes::Sampling;

/// Windows around every eighth point of a cloud, with those through middles.
struct CloudWithMiddles : support::WindowCloud {
  explicit CloudWithMiddles(const Points& points) : WindowCloud(points) {
    findNoise(WindowFitter(ranked.points, source, workers), workers, windows, lists);
    fitThroughMiddles(ranked.points, workers, windows);
  }
};

/// The root of the mean square of heights of the surface over the middles, in spacings.
double rmsHeight(const Windows& windows, int size) {
  double sum = 0;
  for (int w = 0; w < windows.size(); ++w) {
    const double height = windows.fits[w][size].height / windows.spacing(w);
    sum += height * height;
  }
  return std::sqrt(sum / windows.size());
}

TEST(FitThroughMiddles, IsThatOfNeighboursOnAQuadric) {
  Points points = shapes::square(8000, Sampling::uniform, shapes::Rim::included, 3).points;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    points(i, 2) = (points(i, 0) * points(i, 0) - points(i, 1) * points(i, 1)) / 8;
  const CloudWithMiddles cloud(points);
  for (int w = 0; w < cloud.windows.size(); ++w) {
    const auto& fits = cloud.windows.fits[w];
    ASSERT_TRUE(fits[Windows::searched].is_valid) << w;
    EXPECT_LT(std::abs(fits[Windows::searched].height), 1e-3 * cloud.windows.spacing(w)) << w;
    EXPECT_GT(fits[Windows::searched].radius, fits[Windows::searched - 1].radius) << w;
  }
}

// The variance that a quadratic leaves in its middle falls as its points become more, here 320 for 128.
TEST(FitThroughMiddles, LeavesLessNoiseThanTheWidestOfNeighbours) {
  const shapes::Cloud sphere = shapes::sphere(16000, Sampling::uniform, 5);
  const CloudWithMiddles cloud(withNoise(sphere, 0.3 * std::sqrt(sphere.area / 16000), 105).points);
  const double unit = std::ldexp(1, cloud.ranked.exponent);
  const auto left = [&](int size) {
    double sum = 0;
    for (int w = 0; w < cloud.windows.size(); ++w) {
      const int p = cloud.windows.pointOf(w);
      const Eigen::RowVector3d moved =
          cloud.ranked.points.row(p) + cloud.windows.fits[w][size].height * cloud.windows.normal.row(w);
      const double off = (moved * unit).norm() - 1;
      sum += off * off;
    }
    return sum;
  };
  EXPECT_LT(left(Windows::sizes - 1), 0.6 * left(Windows::searched - 1));
  for (int w = 0; w < cloud.windows.size(); ++w) {
    const auto& fits = cloud.windows.fits[w];
    EXPECT_LT(fits.back().leverage, fits[Windows::searched - 1].leverage) << w;
  }
}

// Noise of two spacings doubles base windows, of which each stands for several around it.
TEST(FitThroughMiddles, OfACopyIsThatOfItsWindow) {
  const shapes::Cloud sphere = shapes::sphere(16000, Sampling::uniform, 5);
  const CloudWithMiddles cloud(withNoise(sphere, 2 * std::sqrt(sphere.area / 16000), 105).points);
  int copies = 0;
  for (int w = 0; w < cloud.windows.size(); ++w) {
    if (cloud.windows.is_copy[w] == 0) continue;
    ++copies;
    const int other = cloud.windows.copied(w);
    ASSERT_EQ(cloud.windows.is_copy[other], 0) << w;
    for (int size = 0; size < Windows::sizes; ++size) {
      EXPECT_EQ(cloud.windows.fits[w][size].height, cloud.windows.fits[other][size].height) << w << ' ' << size;
      EXPECT_EQ(cloud.windows.fits[w][size].radius, cloud.windows.fits[other][size].radius) << w << ' ' << size;
    }
  }
  EXPECT_GT(copies, 1000);
  EXPECT_LT(rmsHeight(cloud.windows, Windows::searched), 4);
}

}  // namespace
}  // namespace tufted::middle_windows_test
