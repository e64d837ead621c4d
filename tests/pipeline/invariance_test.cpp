// The operator depends on the shape, not on where it lies, how it is scaled, ordered or computed.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/tufted.h"

namespace tufted::invariance_test {
namespace {

using support::largestDifference;
using support::largestEntry;
using support::sameBits;

class Invariance : public testing::Test {
 protected:
  // Coordinates are multiples of 2^-20, so the moves and scales below are exact.
  static const Points& points() {
    static const Points points = shapes::ellipsoid(16000).points;
    return points;
  }
  static const Laplacian& reference() {
    static const Laplacian laplacian = pointCloudLaplacian(points());
    return laplacian;
  }
};

TEST_F(Invariance, MovedFarAwayGivesTheSameBits) {
  const Points moved = points().rowwise() + Eigen::RowVector3d(500000, 4000000, 100);
  const Laplacian laplacian = pointCloudLaplacian(moved);
  EXPECT_TRUE(sameBits(laplacian.L, reference().L));
  EXPECT_TRUE(sameBits(laplacian.M, reference().M));
}

TEST_F(Invariance, ScaledByPowersOfTwoGivesTheSameBits) {
  for (const int exponent : {27, -27}) {
    const Laplacian laplacian = pointCloudLaplacian(std::ldexp(1.0, exponent) * points());
    EXPECT_TRUE(sameBits(laplacian.L, reference().L)) << exponent;
    EXPECT_TRUE(sameBits(laplacian.M, VectorXd(std::ldexp(1.0, 2 * exponent) * reference().M))) << exponent;
  }
}

TEST_F(Invariance, PermutedGivesThePermutedBits) {
  const std::vector<int> order = shapes::Random(7).permutation(static_cast<int>(points().rows()));
  const Laplacian laplacian = pointCloudLaplacian(support::permuted(points(), order));
  EXPECT_TRUE(sameBits(laplacian.L, support::permuted(reference().L, order)));
  VectorXd M(points().rows());
  for (Eigen::Index i = 0; i < M.size(); ++i) M[i] = reference().M[order[i]];
  EXPECT_TRUE(sameBits(laplacian.M, M));
}

TEST_F(Invariance, AnyNumberOfThreadsGivesTheSameBits) {
  for (const Gluing gluing : {Gluing::star, Gluing::vertex_pair}) {
    const Laplacian one = pointCloudLaplacian(points(), {.threads = 1, .paper = {.gluing = gluing}});
    for (const int threads : {2, 4}) {
      const Laplacian many = pointCloudLaplacian(points(), {.threads = threads, .paper = {.gluing = gluing}});
      EXPECT_TRUE(sameBits(many.L, one.L)) << threads;
      EXPECT_TRUE(sameBits(many.M, one.M)) << threads;
      EXPECT_EQ(many.cover().glue, one.cover().glue) << threads;
      EXPECT_EQ(many.cover().faces, one.cover().faces) << threads;
      EXPECT_EQ(many.cover().length, one.cover().length) << threads;
      EXPECT_EQ(many.report.mean_squared_edge, one.report.mean_squared_edge) << threads;
    }
  }
}

TEST_F(Invariance, TurnedOrScaledChangesNothingButRounding) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto expectSame = [&](const Points& changed, double area_scale) {
    const Laplacian laplacian = pointCloudLaplacian(changed);
    EXPECT_LE(largestDifference(laplacian.L, reference().L), 1e-9 * largestEntry(reference().L));
    EXPECT_LE((laplacian.M / area_scale - reference().M).cwiseAbs().maxCoeff(), 1e-9 * reference().M.maxCoeff());
  };
  expectSame(points() * turn.transpose(), 1);
  expectSame(1e8 * points(), 1e16);
  expectSame(1e-8 * points(), 1e-16);
}

TEST_F(Invariance, BothBackendsGiveTheSameBits) {
#ifdef TUFTED_WITH_GPL
  const Laplacian laplacian = pointCloudLaplacian(points(), {.paper = {.delaunay = Delaunay::cgal}});
  EXPECT_TRUE(sameBits(laplacian.L, reference().L));
  EXPECT_TRUE(sameBits(laplacian.M, reference().M));
  EXPECT_EQ(laplacian.report.votes, reference().report.votes);
#else
  EXPECT_THROW(pointCloudLaplacian(points(), {.paper = {.delaunay = Delaunay::cgal}}), InvalidInput);
#endif
}

TEST_F(Invariance, TheFaceOrderMattersLittle) {
  // Section 5.4: pools of more than two faces are rare with `star`, so the orders differ in few rows.
  for (const FaceOrder order : {FaceOrder::area, FaceOrder::random}) {
    const Laplacian laplacian = pointCloudLaplacian(points(), {.paper = {.order = order, .seed = 3}});
    EXPECT_TRUE(validate(laplacian.cover()).ok());
    const SparseMatrix difference = laplacian.L - reference().L;
    int rows = 0;
    for (int j = 0; j < difference.outerSize(); ++j) {
      bool differs = false;
      for (SparseMatrix::InnerIterator it(difference, j); it; ++it) differs |= std::abs(it.value()) > 1e-9;
      rows += differs ? 1 : 0;
    }
    EXPECT_LT(rows, 0.02 * points().rows());
  }
}

TEST_F(Invariance, TheRandomOrderFollowsItsSeed) {
  const auto build = [&](std::uint64_t seed) {
    return pointCloudLaplacian(points(),
                               {.paper = {.gluing = Gluing::vertex_pair, .order = FaceOrder::random, .seed = seed}});
  };
  const Laplacian one = build(1);
  EXPECT_TRUE(sameBits(build(1).L, one.L));
  EXPECT_FALSE(sameBits(build(2).L, one.L));
}

}  // namespace
}  // namespace tufted::invariance_test
