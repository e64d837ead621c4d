// Clouds with noise are built from where their points lie on the surface.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "shapes/distances.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/denoise.h"
#include "tufted/tufted.h"

namespace tufted::noise_test {
namespace {

using shapes::Cloud;
using shapes::Sampling;
using support::sameBits;

CloudOptions withoutDenoise() {
  CloudOptions options;
  options.steps.denoise = false;
  return options;
}

Cloud noisySphere(double sigma, std::uint64_t seed = 1) {
  return withNoise(shapes::sphere(8000, Sampling::uniform, seed), sigma, seed + 100);
}

TEST(Noise, ExactCloudsHaveTheSameBitsWithAndWithoutLookingForIt) {
  for (const Cloud& cloud : {shapes::sphere(8000), shapes::cubeSurface(8000), shapes::crossingPlanes(8000),
                             shapes::sphere(8000, Sampling::scanLines(20)), shapes::lidar({})}) {
    const Laplacian looked = pointCloudLaplacian(cloud.points),
                    plain = pointCloudLaplacian(cloud.points, withoutDenoise());
    EXPECT_TRUE(sameBits(looked.L, plain.L)) << cloud.name;
    EXPECT_TRUE(sameBits(looked.M, plain.M)) << cloud.name;
    EXPECT_EQ(looked.report.noise, 0) << cloud.name;
  }
}

TEST(Noise, PointsAreMeasuredWhereDenoisePutsThem) {
  const Cloud cloud = noisySphere(0.01);
  const Laplacian laplacian = pointCloudLaplacian(cloud.points);
  const DenoisedPoints denoised = denoise(cloud.points);
  ASSERT_EQ(denoised.report.moved, 8000);
  EXPECT_TRUE(laplacian.positions == denoised.positions);
  EXPECT_EQ(laplacian.report.denoised, 8000);
  EXPECT_EQ(laplacian.report.noise, denoised.report.noise);
  EXPECT_NEAR(laplacian.report.noise, 0.01, 0.0015);
}

TEST(Noise, StarsAgreeAsOnAnExactCloud) {
  for (const double sigma : {0.01, 0.02}) {
    const Cloud cloud = noisySphere(sigma);
    const Report moved = pointCloudLaplacian(cloud.points).report;
    const Report plain = pointCloudLaplacian(cloud.points, withoutDenoise()).report;
    EXPECT_LT(moved.votes[0] + moved.votes[1], moved.votes[2] / 50) << sigma;
    EXPECT_LT(moved.flips, plain.flips / 20) << sigma;
    EXPECT_NEAR(moved.area, 4 * M_PI, 0.02) << sigma;
  }
}

TEST(Noise, OfACapMovesNoPointFarFromIt) {
  Cloud cloud = shapes::sphere(8000);
  const Cloud noisy = noisySphere(0.01);
  for (Eigen::Index i = 0; i < 8000; ++i)
    if (cloud.points(i, 2) > 0.8) cloud.points.row(i) = noisy.points.row(i);
  const Laplacian laplacian = pointCloudLaplacian(cloud.points);
  EXPECT_GT(laplacian.report.denoised, 400);
  for (Eigen::Index i = 0; i < 8000; ++i) {
    if (cloud.points(i, 2) < 0.4) {
      ASSERT_EQ(laplacian.positions.row(i), cloud.points.row(i)) << i;
    }
  }
}

// The slab's margin is 64 spacings.
TEST(Noise, OfASlabOfTheCloudIsThatOfTheCloud) {
  const int n = 100000;
  const Cloud whole = shapes::withNoise(shapes::sphere(n), 0.5 * std::sqrt(4 * std::numbers::pi / n), 5);
  const double margin = 64 * std::sqrt(4 * std::numbers::pi / n);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < n; ++i)
    if (std::abs(whole.points(i, 2)) < 0.1 + margin) rows.push_back(i);
  const Laplacian of_whole = pointCloudLaplacian(whole.points);
  const Laplacian of_slab = pointCloudLaplacian(whole.points(rows, Eigen::all));
  ASSERT_GT(of_whole.report.denoised, 0.9 * n);
  int compared = 0;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (std::abs(whole.points(rows[row], 2)) > 0.1) continue;
    const auto i = static_cast<int>(rows[row]), k = static_cast<int>(row);
    ASSERT_NEAR(of_slab.M[k], of_whole.M[i], 1e-12 * of_whole.M[i]);
    ASSERT_EQ(of_slab.L.col(k).nonZeros(), of_whole.L.col(i).nonZeros());
    SparseMatrix::InnerIterator a(of_slab.L, k), b(of_whole.L, i);
    for (; a; ++a, ++b) {
      ASSERT_EQ(rows[static_cast<std::size_t>(a.row())], b.row());
      ASSERT_NEAR(a.value(), b.value(), 1e-12 * of_whole.L.coeff(i, i));
    }
    ++compared;
  }
  EXPECT_GT(compared, n / 20);
}

TEST(Noise, IsFoundWhateverExactPointsLieFarAway) {
  const Cloud noisy = noisySphere(0.01, 7);
  const auto off = [](const Points& positions) {
    return std::sqrt((positions.topRows(8000).rowwise().norm().array() - 1).square().mean());
  };
  const double alone = off(pointCloudLaplacian(noisy.points).positions);
  for (const auto& [far, size] : {std::pair(shapes::sphere(16000).points, 0.3),
                                  {shapes::cubeSurface(40000).points, 5.0},
                                  {shapes::crossingPlanes(80000).points, 2.0}}) {
    Points points(8000 + far.rows(), 3);
    points << noisy.points, (size * far).rowwise() + Eigen::RowVector3d(30, 0, 0);
    const Laplacian laplacian = pointCloudLaplacian(points);
    EXPECT_LT(off(laplacian.positions), 1.2 * alone) << far.rows();
    // What step 5 moves next to creases is moved in any case.
    const Points unmoved = pointCloudLaplacian(points, withoutDenoise()).positions.bottomRows(far.rows());
    EXPECT_TRUE(laplacian.positions.bottomRows(far.rows()) == unmoved) << far.rows();
  }
}

TEST(Noise, AnyNumberOfThreadsGivesTheSameBits) {
  const Points points = withNoise(shapes::cubeSurface(8000), 0.01, 7).points;
  CloudOptions options;
  options.threads = 1;
  const Laplacian one = pointCloudLaplacian(points, options);
  EXPECT_GT(one.report.noise, 0);
  for (const int threads : {2, 3}) {
    options.threads = threads;
    const Laplacian many = pointCloudLaplacian(points, options);
    EXPECT_TRUE(sameBits(many.L, one.L)) << threads;
    EXPECT_TRUE(sameBits(many.M, one.M)) << threads;
  }
}

TEST(Noise, EdgesOfACubeStaySharp) {
  const Cloud cloud = withNoise(shapes::cubeSurface(16000, 2), 0.01, 102);
  const Laplacian laplacian = pointCloudLaplacian(cloud.points);
  EXPECT_NEAR(laplacian.report.area, 6, 0.06);
  EXPECT_LT(shapes::rmsDistance(laplacian.positions, shapes::toCube),
            0.25 * shapes::rmsDistance(cloud.points, shapes::toCube));
}

}  // namespace
}  // namespace tufted::noise_test
