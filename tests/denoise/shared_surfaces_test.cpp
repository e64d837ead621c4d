#include "denoise/shared_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "denoise/middle_windows.h"
#include "shapes/shapes.h"
#include "support/window_cloud.h"

namespace tufted::shared_surfaces_test {
namespace {

using shapes::Sampling;

/// Windows around every eighth point of a cloud, which count as noisy and smooth.
struct SharedCloud : support::WindowCloud {
  NoiseLevel noise;
  WindowChoice choice;
  PointBuffer move;
  RawBuffer<double> variance;
  SharedSurfaces shared;

  SharedCloud(const Points& points, double sigma) : WindowCloud(points) {
    Buffer<int> all(windows.base.size());
    std::iota(all.begin(), all.end(), 0);
    const WindowFitter fitter(ranked.points, source, workers);
    fitter.take(all, windows, &lists);
    fitter.spreadPools(all, lists, windows);
    fitThroughMiddles(ranked.points, workers, windows);
    noise.variance.resize(all.size());
    for (double& variance_of_window : noise.variance) variance_of_window = sigma * sigma;
    noise.outlier.assign(all.size(), 0);
    noise.noisy.assign(all.size(), 1);
    choice.window.assign(all.size(), 3);
    choice.biased.assign(all.size(), 0);
  }

  void share() {
    shared = shareSurfaces(ranked.points, source, lists, windows, noise, choice, workers, move, variance);
  }
};

/// Points of z = (x^2 - y^2) / 8, on which every fit is exact.
Points quadric() {
  Points points = shapes::square(4000).points;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    points(i, 2) = (points(i, 0) * points(i, 0) - points(i, 1) * points(i, 1)) / 8;
  return points;
}

TEST(SharedSurfaces, OfAPlaneLeaveItsPointsWhereTheyAre) {
  SharedCloud cloud(shapes::square(4000).points, 0.01);
  cloud.share();
  EXPECT_EQ(std::count(cloud.shared.settled.begin(), cloud.shared.settled.end(), 1), 4000);
  EXPECT_LT(cloud.move.all().cwiseAbs().maxCoeff(), 1e-14);
}

TEST(SharedSurfaces, BringAPointBackThatAloneIsOff) {
  Points points = quadric();
  points(1234, 2) += 0.002;
  SharedCloud cloud(points, 0.01);
  cloud.share();
  for (int p = 0; p < cloud.ranked.size(); ++p) {
    const double way = cloud.move.row(p).norm();
    const double unit = std::ldexp(1, -cloud.ranked.exponent);
    EXPECT_NEAR(way, cloud.ranked.input_index[p] == 1234 ? 0.002 * unit : 0, 3e-4 * unit) << p;
  }
}

TEST(SharedSurfaces, OfMiddlesBringAPointBackThatAloneIsOff) {
  Points points = quadric();
  points(1234, 2) += 0.002;
  SharedCloud cloud(points, 0.01);
  cloud.choice.window.assign(cloud.choice.window.size(), Windows::searched);
  cloud.share();
  const double unit = std::ldexp(1, -cloud.ranked.exponent);
  for (int p = 0; p < cloud.ranked.size(); ++p)
    EXPECT_NEAR(cloud.move.row(p).norm(), cloud.ranked.input_index[p] == 1234 ? 0.002 * unit : 0, 3e-4 * unit) << p;
}

// The variance of the noise times the mean curvature, 1/4 of z = (x^2 + y^2) / 8, is taken back, away from the centre
// of curvature above.
TEST(SharedSurfaces, TakeBackSomeOfWhatNoiseOnABowlDoes) {
  Points points = shapes::square(4000).points;
  points.col(0).array() -= 0.5;
  points.col(1).array() -= 0.5;
  points.col(2) = points.leftCols(2).rowwise().squaredNorm() / 8;
  const double sigma = 0.05;
  const double unit = std::ldexp(1, -support::ranked(points).exponent);
  SharedCloud cloud(points, sigma * unit);
  cloud.share();
  const double way = sigma * sigma / 4;
  for (int p = 0; p < cloud.ranked.size(); ++p) {
    if (points.row(cloud.ranked.input_index[p]).head(2).norm() > 0.3) continue;
    EXPECT_NEAR(cloud.move.row(p)[2], -way * unit, 0.05 * way * unit) << p;
  }
}

TEST(SharedSurfaces, SettleNoPointThatIsFarOff) {
  Points points = quadric();
  points(1234, 2) += 0.5;
  SharedCloud cloud(points, 0.01);
  cloud.share();
  for (int p = 0; p < cloud.ranked.size(); ++p)
    EXPECT_TRUE(cloud.ranked.input_index[p] != 1234 || cloud.shared.settled[p] == 0);
}

TEST(SharedSurfaces, OfWindowsBiasedFromTheBaseOnSettleNothingAndOfQuietOnesLetAllStay) {
  SharedCloud cloud(quadric(), 0.01);
  cloud.choice.biased.assign(cloud.choice.biased.size(), 1);
  cloud.choice.window.assign(cloud.choice.window.size(), 0);
  cloud.share();
  EXPECT_EQ(std::count(cloud.shared.settled.begin(), cloud.shared.settled.end(), 1), 0);
  cloud.noise.noisy.assign(cloud.noise.noisy.size(), 0);
  cloud.share();
  EXPECT_EQ(std::count(cloud.shared.settled.begin(), cloud.shared.settled.end(), 1), 4000);
  EXPECT_TRUE(cloud.move.all().isZero(0));
}

// There are more base windows than others, so that every point is in some.
TEST(SharedSurfaces, OfBaseWindowsSettleAllPointsWhereWiderOnesBend) {
  Points points = quadric();
  points(1234, 2) += 0.002;
  SharedCloud cloud(points, 0.01);
  cloud.choice.biased.assign(cloud.choice.biased.size(), 1);
  cloud.choice.window.assign(cloud.choice.window.size(), 1);
  cloud.share();
  EXPECT_GT(std::count(cloud.shared.settled.begin(), cloud.shared.settled.end(), 1), 3990);
  const double unit = std::ldexp(1, -cloud.ranked.exponent);
  for (int p = 0; p < cloud.ranked.size(); ++p)
    EXPECT_NEAR(cloud.move.row(p).norm(), cloud.ranked.input_index[p] == 1234 ? 0.002 * unit : 0, 6e-4 * unit) << p;
}

TEST(MayBeNoisy, IsTrueOfNoiseAndFalseOfExactPoints) {
  const auto asks = [](const shapes::Cloud& cloud) {
    const RankedCloud ranked = support::ranked(cloud.points);
    const NeighborSource source = windowSource(std::make_unique<NeighborSearch>(ranked.points), ranked.size());
    return mayBeNoisy(ranked.points, source, Workers(1, support::silent));
  };
  for (const auto& cloud :
       {shapes::sphere(8000), shapes::torus(8000), shapes::cylinderPatch(8000), shapes::saddle(8000),
        shapes::squareLattice(), shapes::sphere(8000, Sampling::densityStep(16))}) {
    EXPECT_FALSE(asks(cloud)) << cloud.name;
    for (const double sigma : {0.001, 0.01, 0.03}) EXPECT_TRUE(asks(withNoise(cloud, sigma, 7))) << cloud.name << sigma;
  }
}

}  // namespace
}  // namespace tufted::shared_surfaces_test
