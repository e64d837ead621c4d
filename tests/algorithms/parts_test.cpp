// A component has the results that it has alone, whatever else there is, and no algorithm computes with the report.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "shapes/shapes.h"
#include "support/algorithms.h"
#include "support/compare.h"

namespace tufted::parts_test {
namespace {

using Eigen::MatrixXd;
using support::Algorithm;
using support::difference;

/// A fine shape, and far away a coarse one with other edges, another noise and other areas. They have at most 5,000
/// points together: beyond, marching cuts triangles once and not twice.
struct Scene {
  std::string name;
  Points fine, far;

  Points together() const {
    Points points(fine.rows() + far.rows(), 3);
    points << fine, far;
    return points;
  }
};

std::vector<Scene> scenes() {
  const auto placed = [](const Points& points, double size) -> Points {
    return (size * points).rowwise() + Eigen::RowVector3d(4 * size, 0, 0);
  };
  const Points fine = shapes::torus(800).points;
  const shapes::Cloud noisy = shapes::withNoise(shapes::sphere(1500), 0.03, 3);
  return {{"coarse", fine, placed(shapes::sphere(1200).points, 300)},
          {"huge", shapes::ellipsoid(800).points, placed(shapes::sphere(1000).points, 1e6)},
          {"noisy", fine, placed(noisy.points, 10)}};
}

/// Where there is no mollification, whose length is one for the whole cloud.
CloudOptions exact() {
  CloudOptions options;
  options.mollify = 0;
  return options;
}

TEST(Parts, HaveTheResultsThatTheyHaveAlone) {
  for (const Scene& scene : scenes()) {
    const Points together = scene.together();
    const Laplacian alone = pointCloudLaplacian(scene.fine, exact()), whole = pointCloudLaplacian(together, exact());
    ASSERT_EQ(alone.report.components, 1) << scene.name;
    const Laplacian part = restrictedTo(whole, {whole.component[0]});
    ASSERT_EQ(part.report.active, scene.fine.rows()) << scene.name;
    EXPECT_NEAR(part.report.mean_edge, alone.report.mean_edge, 1e-12 * alone.report.mean_edge);
    EXPECT_NEAR(part.report.mean_squared_edge, alone.report.mean_squared_edge, 1e-12 * alone.report.mean_squared_edge);
    for (const Algorithm& algorithm : support::algorithms()) {
      if (!algorithm.is_local) continue;
      const MatrixXd expected = algorithm.run(alone, scene.fine);
      EXPECT_LE(difference(algorithm.run(part, together), expected), 1e-6) << scene.name << ", " << algorithm.name;
      EXPECT_LE(difference(algorithm.run(whole, together), expected), 1e-6) << scene.name << ", " << algorithm.name;
    }
  }
}

TEST(Parts, OfMeshesHaveTheirOwnEdges) {
  const shapes::Mesh ball = shapes::icosphere(3), coarse = shapes::icosphere(1);
  const auto n = static_cast<int>(ball.points.rows());
  Points points(n + coarse.points.rows(), 3);
  points << ball.points, (100 * coarse.points).rowwise() + Eigen::RowVector3d(500, 0, 0);
  Triangles triangles(ball.triangles.rows() + coarse.triangles.rows(), 3);
  triangles << ball.triangles, coarse.triangles.array() + n;
  const Laplacian alone = meshLaplacian(ball.points, ball.triangles), whole = meshLaplacian(points, triangles);
  ASSERT_EQ(whole.component_edges.size(), 2u);
  EXPECT_EQ(whole.component_edges[0].sides, 3 * ball.triangles.rows());
  EXPECT_EQ(whole.component_edges[1].sides, 3 * coarse.triangles.rows());
  EXPECT_NEAR(whole.component_edges[0].mean, alone.report.mean_edge, 1e-12);
  EXPECT_NEAR(whole.component_edges[0].mean_square, alone.report.mean_squared_edge, 1e-12);
  const Points expected = smooth(alone, ball.points);
  EXPECT_LE((smooth(whole, points).topRows(n) - expected).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LE((smooth(restrictedTo(whole, {0}), points).topRows(n) - expected).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Report, IsForPeopleAndNothingComputesWithIt) {
  shapes::Cloud noisy = shapes::withNoise(shapes::torus(1500), 0.02, 5);
  noisy.points.row(70) = noisy.points.row(5);
  for (const Points& points : {noisy.points, shapes::sphere(600).points}) {
    const Laplacian laplacian = pointCloudLaplacian(points);
    Laplacian bare = laplacian;
    bare.report = {};
    for (const Algorithm& algorithm : support::algorithms()) {
      const MatrixXd with = algorithm.run(laplacian, points), without = algorithm.run(bare, points);
      ASSERT_EQ(with.rows(), without.rows()) << algorithm.name;
      EXPECT_TRUE(support::sameBits(with.data(), without.data(), static_cast<std::size_t>(with.size())))
          << algorithm.name;
    }
  }
}

TEST(ComponentEdges, AreTheSameByBothBuildsAndForAnyThreads) {
  Points points = scenes()[0].together();
  points.row(2).setConstant(NAN);
  CloudOptions options;
  options.threads = 1;
  const Laplacian one = pointCloudLaplacian(points, options);
  options.threads = 3;
  const Laplacian three = pointCloudLaplacian(points, options);
  options.paper.gluing = Gluing::vertex_pair;
  const Laplacian reference = pointCloudLaplacian(points, options);
  ASSERT_EQ(one.component_edges.size(), 2u);
  ASSERT_EQ(reference.component_edges.size(), 2u);
  std::int64_t sides = 0;
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_EQ(one.component_edges[c].mean_square, three.component_edges[c].mean_square);
    EXPECT_EQ(one.component_edges[c].mean, three.component_edges[c].mean);
    EXPECT_EQ(one.component_edges[c].sides, reference.component_edges[c].sides);
    EXPECT_NEAR(one.component_edges[c].mean / reference.component_edges[c].mean, 1, 1e-12);
    EXPECT_NEAR(one.component_edges[c].mean_square / reference.component_edges[c].mean_square, 1, 1e-12);
    sides += one.component_edges[c].sides;
  }
  EXPECT_EQ(sides, 3 * one.report.triangles);
}

TEST(Noise, IsKeptPerPointAndFollowsTheParts) {
  const double weak = 0.01, strong = 0.03;
  const Points first = shapes::withNoise(shapes::sphere(6000), weak, 1).points;
  const Points second = shapes::withNoise(shapes::sphere(6000), strong, 2).points;
  Points points(12000, 3);
  points << first, (2 * second).rowwise() + Eigen::RowVector3d(10, 0, 0);
  points.row(11999) = points.row(11998);
  const Laplacian laplacian = pointCloudLaplacian(points);
  ASSERT_EQ(laplacian.noise.size(), 12000);
  EXPECT_NEAR(laplacian.noise.head(6000).mean(), weak, 0.2 * weak);
  EXPECT_NEAR(laplacian.noise.tail(6000).mean(), 2 * strong, 0.2 * 2 * strong);
  EXPECT_EQ(laplacian.noise[11999], laplacian.noise[11998]);
  const Laplacian part = restrictedTo(laplacian, {laplacian.component[0]});
  EXPECT_NEAR(part.report.noise, weak, 0.2 * weak);
  EXPECT_EQ(part.report.denoised, 6000);
  EXPECT_EQ(pointCloudLaplacian(shapes::sphere(1000).points).noise.size(), 0);
}

}  // namespace
}  // namespace tufted::parts_test
