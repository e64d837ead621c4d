// At a step of density the nearest neighbours of a point on the dense side are all on that side.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/laplacian.h"

namespace tufted {
namespace {

Points torusWithStep(int n) {
  return shapes::torus(n, shapes::Sampling::densityStep(16)).points;
}

TEST(StarWidening, LeavesNoGapAtAStepOfDensity) {
  const double area = 4 * std::numbers::pi * std::numbers::pi * 0.4;
  const Laplacian laplacian = pointCloudLaplacian(torusWithStep(16000));
  EXPECT_NEAR(laplacian.M.sum() / area, 1, 5e-3);  // 2e-2 without
  EXPECT_GT(laplacian.report.closed_stars, 20);
}

TEST(StarWidening, IsTheSameForAnyNumberOfThreads) {
  const Points points = torusWithStep(4000);
  const Laplacian one = pointCloudLaplacian(points, {.threads = 1});
  for (const int threads : {2, 7}) {
    const Laplacian many = pointCloudLaplacian(points, {.threads = threads});
    EXPECT_TRUE(support::sameBits(many.L, one.L)) << threads;
    EXPECT_TRUE(support::sameBits(many.M, one.M)) << threads;
  }
}

}  // namespace
}  // namespace tufted
