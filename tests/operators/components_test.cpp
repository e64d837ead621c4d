// Connected components, and Laplacians of some of them.
#include "tufted/components.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <string_view>
#include <vector>

#include "shapes/shapes.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::components_test {
namespace {

constexpr int small = 300, large = 500;

/// Two spheres, the smaller one first, and a third one that is as large as the first.
Points threeSpheres() {
  Points points(small + large + small, 3);
  points << shapes::sphere(small).points, shapes::sphere(large).points.rowwise() + Eigen::RowVector3d(10, 0, 0),
      shapes::sphere(small).points.rowwise() + Eigen::RowVector3d(0, 10, 0);
  points.row(4) = points.row(2);
  points.row(7).setConstant(NAN);
  return points;
}

std::vector<int> expectedLabels() {
  std::vector<int> labels(2 * small + large, 2);
  std::fill_n(labels.begin() + small, large, 0);
  std::fill_n(labels.begin() + small + large, small, 1);  // of 300 active points, and the first one of 298
  labels[7] = -1;
  return labels;
}

TEST(Components, AreNumberedByTheirSize) {
  const Laplacian laplacian = pointCloudLaplacian(threeSpheres());
  EXPECT_EQ(laplacian.component, expectedLabels());
  EXPECT_EQ(componentLabels(laplacian), expectedLabels());
  EXPECT_EQ(componentSizes(laplacian.component), (std::vector<std::int64_t>{500, 300, 299}));
  EXPECT_EQ(laplacian.report.components, 3);
}

TEST(Components, OfEqualSizeAreNumberedByTheirFirstPoint) {
  Points points(200, 3);
  points << shapes::sphere(100).points, shapes::sphere(100).points.rowwise() + Eigen::RowVector3d(10, 0, 0);
  std::vector<int> order(200);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  const Laplacian laplacian = pointCloudLaplacian(points(order, Eigen::all));
  const int first = order[0] / 100;
  for (int i = 0; i < 200; ++i) EXPECT_EQ(laplacian.component[i], order[i] / 100 == first ? 0 : 1);
}

TEST(Components, OfMeshesAreThoseOfTheirEdges) {
  const shapes::Mesh ball = shapes::icosphere(1);
  const auto n = static_cast<int>(ball.points.rows());
  Points points(2 * n + 1, 3);
  points << ball.points, ball.points.array() + 10, Eigen::RowVector3d(50, 0, 0);
  Triangles triangles(2 * ball.triangles.rows(), 3);
  triangles << ball.triangles, ball.triangles.array() + n;
  const Laplacian laplacian = meshLaplacian(points, triangles);
  EXPECT_EQ(laplacian.component[0], 0);
  EXPECT_EQ(laplacian.component[n], 1);
  EXPECT_EQ(laplacian.component[2 * n], -1);
  EXPECT_EQ(laplacian.component, componentLabels(laplacian));
}

TEST(Components, AreLeftOutByRestriction) {
  const Laplacian laplacian = pointCloudLaplacian(threeSpheres());
  const Laplacian some = restrictedTo(laplacian, {2, 1});
  EXPECT_TRUE(validate(some).ok());
  EXPECT_EQ(some.report.components, 2);
  EXPECT_EQ(some.report.active, 2 * small - 2);
  EXPECT_EQ(some.report.coincident, 1);
  EXPECT_EQ(some.report.isolated, large);
  EXPECT_EQ(some.component[0], 1);
  EXPECT_EQ(some.component[small], -1);
  EXPECT_EQ(some.component[small + large], 0);
  EXPECT_EQ(some.component, componentLabels(some));
  const SparseMatrix block = laplacian.L.block(0, 0, small, small);
  EXPECT_EQ((SparseMatrix(some.L.block(0, 0, small, small)) - block).norm(), 0);
  EXPECT_EQ(some.M.segment(small, large), VectorXd::Zero(large));
  // Its cover is that of these components, and all that uses it gives what it gave.
  EXPECT_TRUE(validate(some.cover()).ok());
  const VectorXd before = DistanceSolver(laplacian).query({0}), after = DistanceSolver(some).query({0});
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(after[i], before[i], 0.02);
  for (int i = 8; i < small; ++i) EXPECT_NEAR(after[i], before[i], 0.02);
  EXPECT_EQ(after[small], INFINITY);
  const Laplacian same = restrictedTo(laplacian, {0, 1, 2, 2});
  EXPECT_EQ((same.L - laplacian.L).norm(), 0);
  EXPECT_EQ(same.component, laplacian.component);
}

TEST(Components, RefuseLabelsThatNoneHas) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(100).points);
  EXPECT_EQ(support::refusal([&] { restrictedTo(laplacian, {1}); }), "restrictedTo: component 1, must lie in [0, 1)");
  EXPECT_EQ(restrictedTo(laplacian, {}).report.active, 0);
  EXPECT_TRUE(componentLabels(pointCloudLaplacian(Points(0, 3))).empty());
}

TEST(Components, CancelAtEveryCall) {
  const Laplacian laplacian = pointCloudLaplacian(threeSpheres());
  int calls = 0;
  const auto restrictUntil = [&](int stop) {
    calls = 0;
    return restrictedTo(laplacian, {0, 2}, [&](std::string_view, double) { return ++calls < stop; });
  };
  const Laplacian whole = restrictUntil(INT32_MAX), silent = restrictedTo(laplacian, {0, 2});
  EXPECT_EQ((whole.L - silent.L).norm(), 0);
  EXPECT_EQ(whole.cover().glue, silent.cover().glue);
  EXPECT_EQ(whole.cover().length, silent.cover().length);
  const int all = calls;
  EXPECT_GE(all, 6);
  for (int stop = 1; stop <= all; ++stop) EXPECT_THROW(restrictUntil(stop), Cancelled) << stop << " of " << all;
}

TEST(Components, HaveTheirConstantsInHeatSignatures) {
  const Laplacian laplacian = pointCloudLaplacian(threeSpheres());
  const Spectrum positive = spectrum(laplacian, 30, {.null_space = false});
  const Spectrum all = spectrum(laplacian, 33);
  const VectorXd times = heatTimes(positive);
  const Eigen::MatrixXd with = heatKernelSignature(laplacian, positive, times), whole = heatKernelSignature(all, times);
  EXPECT_LE((with - whole).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_EQ(with.row(7), Eigen::RowVectorXd::Zero(times.size()));
  EXPECT_EQ(support::refusal([&] { heatKernelSignature(laplacian, all, times); }),
            "heatKernelSignature: spectrum has the eigenvalue 0, must have positive ones alone");
}

}  // namespace
}  // namespace tufted::components_test
