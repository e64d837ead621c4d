#include "stars/quadratic_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "shapes/random.h"
#include "stars/offsets.h"
#include "stars/tangent_frame.h"

namespace tufted::quadratic_fit_test {
namespace {

/// Row 0 at the middle, the others around it on h(u, v), all moved far away.
template <class Height>
Points surface(int n, const Height& height) {
  shapes::Random random(5);
  Points points(n, 3);
  for (int i = 0; i < n; ++i) {
    const double u = i == 0 ? 0 : 2 * random.uniform() - 1, v = i == 0 ? 0 : 2 * random.uniform() - 1;
    points.row(i) << u + 1000, v - 2000, height(i, u, v);
  }
  return points;
}

Buffer<Neighbor> allOthers(const Points& points) {
  Buffer<Neighbor> neighbors;
  for (int i = 1; i < points.rows(); ++i) neighbors.push_back({(points.row(i) - points.row(0)).squaredNorm(), i});
  return neighbors;
}

HeightFit fitAll(const Points& points, const Eigen::Vector3d& normal = Eigen::Vector3d::UnitZ()) {
  OffsetBuffer offsets;
  offsets.take(points, 0, allOthers(points));
  const HeightMoments moments = heightMoments(offsets.view(), normal, 1.5);
  HeightFit fit;
  fitHeights({&moments, 1}, {&fit, 1});
  return fit;
}

TEST(HeightFit, OfAQuadricIsTheQuadric) {
  const auto quadric = [](int, double u, double v) { return 0.3 * u - 0.1 * v + 0.5 * u * u - u * v + 0.2 * v * v; };
  const HeightFit fit = fitAll(surface(30, quadric));
  ASSERT_TRUE(fit.is_valid);
  EXPECT_NEAR(fit.height, 0, 1e-9);
  EXPECT_NEAR(fit.variance, 0, 1e-9);
}

TEST(HeightFit, FindsHowFarAPointLiesOffTheSurfaceOfTheOthers) {
  // The more neighbours, the less does p itself pull.
  const HeightFit fit = fitAll(surface(2000, [](int i, double u, double v) { return u * v + (i == 0 ? 0.25 : 0); }));
  EXPECT_NEAR(fit.height, -0.25, 0.005);
}

TEST(HeightFit, OfNoiseHasItsVariance) {
  shapes::Random random(9);
  const double sigma = 0.02;
  const HeightFit fit = fitAll(surface(4000, [&](int, double u, double) { return u * u + sigma * random.normal(); }));
  EXPECT_NEAR(std::sqrt(fit.variance) / sigma, 1, 0.05);
}

TEST(HeightFit, WithWeightsOfASphereIsExactHoweverWide) {
  const auto sphere = [](int, double u, double v) { return 1.5 - std::sqrt(2.25 - u * u - v * v); };
  for (const int n : {20, 21, 200}) {
    OffsetBuffer offsets;
    const Points points = surface(n, sphere);
    offsets.take(points, 0, allOthers(points));
    const double radius = 2;
    const HeightFit fit = fitHeights(weightedMoments(offsets.view(), Eigen::Vector3d::UnitZ(), radius));
    ASSERT_TRUE(fit.is_valid);
    for (const int slope : {0, 1, 2}) EXPECT_NEAR(fit.coefficient[slope], 0, 1e-9) << n;
    EXPECT_NEAR(2 * fit.coefficient[3] / radius, 1 / 1.5, 1e-9);
    EXPECT_NEAR(fit.coefficient[4], 0, 1e-9);
    EXPECT_NEAR(2 * fit.coefficient[5] / radius, 1 / 1.5, 1e-9);
  }
}

TEST(HeightFit, OfFewPointsOrPointsOfOneLineIsNone) {
  EXPECT_FALSE(fitAll(surface(8, [](int, double u, double v) { return u * v; })).is_valid);
  EXPECT_TRUE(fitAll(surface(9, [](int, double u, double v) { return u * v; })).is_valid);
  Points line(20, 3);
  for (int i = 0; i < 20; ++i) line.row(i) << 0.1 * i, 0, 0;
  EXPECT_FALSE(fitAll(line).is_valid);
}

/// Against Eigen, on planes, lines, blobs and what lies between.
TEST(PrincipalAxes, AreThoseOfEigenWhateverTheShape) {
  shapes::Random random(3);
  for (const double middle : {0.0, 1e-6, 0.3, 0.999, 1.0}) {
    for (const double smallest : {0.0, 1e-7, 0.5, 0.97, 1.0}) {
      const Eigen::Matrix3d turn = Eigen::Quaterniond(0.1, 0.5, -0.3, 0.8).normalized().toRotationMatrix();
      Points points(31, 3);
      for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const auto coordinate = [&] { return 2 * random.uniform() - 1; };
        const Eigen::Vector3d local(coordinate(), middle * coordinate(), middle * smallest * coordinate());
        points.row(i) = turn * local;
      }
      const PrincipalAxes axes = principalAxes(points, 0, allOthers(points));
      const Points centered = points.rowwise() - points.colwise().mean();
      const Eigen::Matrix3d covariance = centered.transpose() * centered / (31 * axes.extent * axes.extent);
      const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues();
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(axes.variance[k], values[k], 1e-13) << middle << " " << smallest;
      // The normal is an eigenvector of the smallest: nothing varies less.
      EXPECT_NEAR(axes.normal.dot(covariance * axes.normal), values[0], 1e-13) << middle << " " << smallest;
      EXPECT_NEAR(axes.normal.norm(), 1, 1e-14);
    }
  }
}

}  // namespace
}  // namespace tufted::quadratic_fit_test
