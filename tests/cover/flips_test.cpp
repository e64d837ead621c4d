// Algorithm 2 in blocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/build.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/tufted.h"

namespace tufted::flips_test {
namespace {

TEST(Flips, OfSeveralBlocksHaveTheSameBitsOnAnyThreads) {
  const Points points = shapes::withNoise(shapes::sphere(40000), 0.01).points;
  for (const CloudBuild build : {CloudBuild::automatic, CloudBuild::whole_cover}) {
    Laplacian one, several;
    CloudOptions options = cloudOptions(Preset::clean);
    options.threads = 1;
    buildCloudLaplacian(points, options, build, one);
    options.threads = 3;
    buildCloudLaplacian(points, options, build, several);
    EXPECT_GT(one.report.flips, 20000);
    EXPECT_EQ(several.report.flips, one.report.flips);
    EXPECT_TRUE(support::sameBits(several.L, one.L));
    EXPECT_TRUE(support::sameBits(several.M, one.M));
    EXPECT_EQ(several.cover().length, one.cover().length);
    EXPECT_TRUE(validate(one.cover()).ok());
  }
}

TEST(Flips, LeadToOneTriangulationWhateverTheBlocks) {
  shapes::Mesh mesh = shapes::icosphere(6);  // 81920 triangles
  mesh.points.col(1) *= 7;
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  EXPECT_GT(laplacian.report.flips, 10000);
  EXPECT_TRUE(validate(laplacian.cover()).ok());
  EXPECT_TRUE(support::sameBits(meshLaplacian(mesh.points, mesh.triangles, {.threads = 3}).L, laplacian.L));

  Triangles shuffled(mesh.triangles.rows(), 3);  // so that nearly all edges go across
  const std::vector<int> order = shapes::Random(3).permutation(static_cast<int>(shuffled.rows()));
  for (Eigen::Index t = 0; t < shuffled.rows(); ++t) shuffled.row(t) = mesh.triangles.row(order[t]);
  const Laplacian other = meshLaplacian(mesh.points, shuffled);
  EXPECT_TRUE(validate(other.cover()).ok());
  EXPECT_LE(support::largestDifference(other.L, laplacian.L), 1e-9 * support::largestEntry(laplacian.L));
}

TEST(Flips, LeaveNoEdgeOfNeedlesThatIsNotDelaunay) {
  // Points of all magnitudes, joined at random: angles come as close to pi as lengths in doubles allow, and their
  // cotangents to 1e7, where the last bit of a length is worth 1e5.
  for (int seed = 1; seed <= 300; ++seed) {
    shapes::Random random(seed);
    Points points(40, 3);
    for (int i = 0; i < points.rows(); ++i)
      for (int axis = 0; axis < 3; ++axis) points(i, axis) = std::ldexp(random.uniform(-1, 1), random.below(81) - 40);
    Triangles triangles(120, 3);
    for (int t = 0; t < triangles.rows(); ++t)
      for (int s = 0; s < 3; ++s) triangles(t, s) = random.below(40);
    const Laplacian laplacian = meshLaplacian(points, triangles);
    EXPECT_EQ(laplacian.report.flip_failures, 0) << seed;
    EXPECT_TRUE(validate(laplacian.cover()).ok()) << seed;
    EXPECT_TRUE(validate(laplacian).ok()) << seed;
  }
}

}  // namespace
}  // namespace tufted::flips_test
