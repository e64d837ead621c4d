// Bounded biharmonic weights: their conditions, an oracle, symmetries, odd data, and what callers get wrong.
#include "tufted/weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "shapes/shapes.h"
#include "support/defined_values.h"
#include "support/odd_cloud.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::weights_test {
namespace {

using Eigen::MatrixXd;
using support::refusal;

/// The matrix of bending, dense.
MatrixXd bendingOf(const Laplacian& laplacian) {
  const MatrixXd L = laplacian.L;
  return L * laplacian.M.cwiseInverse().asDiagonal() * L;
}

/// Bounded weights before they are divided by their sum, by projected Gauss-Seidel.
VectorXd byGaussSeidel(const MatrixXd& Q, const std::vector<int>& ones, const std::vector<int>& zeros) {
  VectorXd u = VectorXd::Zero(Q.rows());
  std::vector<bool> is_fixed(static_cast<std::size_t>(Q.rows()), false);
  for (const int i : ones) u[i] = 1, is_fixed[i] = true;
  for (const int i : zeros) is_fixed[i] = true;
  for (int sweep = 0; sweep < 200000; ++sweep) {
    double most = 0;
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      if (is_fixed[i]) continue;
      const double next = std::clamp(u[i] - Q.row(i).dot(u) / Q(i, i), 0.0, 1.0);
      most = std::max(most, std::abs(next - u[i]));
      u[i] = next;
    }
    if (most < 1e-15) break;
  }
  return u;
}

TEST(BoundedWeights, AreThoseOfAnotherSolver) {
  for (const shapes::Mesh& mesh : {shapes::gridSquare(7), shapes::icosphere(1), shapes::slivers(4)}) {
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
    const std::vector<std::vector<int>> handles = {{0}, {5, 6}, {20}};
    WeightReport report;
    const MatrixXd weights = boundedBiharmonicWeights(laplacian, handles, {}, &report);
    const MatrixXd Q = bendingOf(laplacian);
    MatrixXd expected(weights.rows(), 3);
    expected.col(0) = byGaussSeidel(Q, {0}, {5, 6, 20});
    expected.col(1) = byGaussSeidel(Q, {5, 6}, {0, 20});
    expected.col(2) = byGaussSeidel(Q, {20}, {0, 5, 6});
    for (auto&& row : expected.rowwise()) row /= row.sum();
    EXPECT_LE((weights - expected).cwiseAbs().maxCoeff(), mesh.name == "slivers" ? 1e-3 : 1e-6) << mesh.name;
    EXPECT_LE(report.residual, 1e-8) << mesh.name;
  }
}

/// Expects the bounds, sums and handles.
void expectWeights(const MatrixXd& weights, const std::vector<std::vector<int>>& handles) {
  EXPECT_GE(weights.minCoeff(), 0);
  EXPECT_LE(weights.maxCoeff(), 1);
  EXPECT_LE((weights.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-14);
  for (std::size_t h = 0; h < handles.size(); ++h)
    for (const int i : handles[h]) EXPECT_EQ(weights(i, static_cast<Eigen::Index>(h)), 1) << i;
}

TEST(BoundedWeights, HoldTheirConditionsOnCloudsAndBadMeshes) {
  const shapes::Mesh bad = shapes::cubeMesh(10, shapes::Quality::bad);
  const Points torus = shapes::torus(1500).points;
  for (const Laplacian& laplacian : {meshLaplacian(bad.points, bad.triangles), pointCloudLaplacian(torus)}) {
    const std::vector<std::vector<int>> handles = {{0, 1}, {100}, {300}, {500}};
    WeightReport report;
    expectWeights(boundedBiharmonicWeights(laplacian, handles, {}, &report), handles);
    EXPECT_LE(report.residual, 1e-8);
    EXPECT_LT(report.iterations, 60);
    EXPECT_EQ(report.not_reached, 0);
  }
}

TEST(BoundedWeights, OfOneHandleAreOne) {
  const shapes::Mesh mesh = shapes::icosphere(2);
  const MatrixXd weights = boundedBiharmonicWeights(meshLaplacian(mesh.points, mesh.triangles), {{3}});
  EXPECT_LE((weights.array() - 1).abs().maxCoeff(), 1e-12);
}

TEST(BoundedWeights, AreAsSymmetricAsTheirHandles) {
  const shapes::Mesh mesh = shapes::icosphere(3);
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  const auto opposite = [&](int i) {
    Eigen::Index best = 0;
    (mesh.points.rowwise() + mesh.points.row(i)).rowwise().norm().minCoeff(&best);
    return static_cast<int>(best);
  };
  const MatrixXd weights = boundedBiharmonicWeights(laplacian, {{0}, {opposite(0)}});
  for (int i = 0; i < weights.rows(); ++i) EXPECT_NEAR(weights(i, 0), weights(opposite(i), 1), 1e-8) << i;
}

TEST(BoundedWeights, OfOddCloudsAreDefined) {
  const Laplacian laplacian = pointCloudLaplacian(support::oddDisk());
  WeightReport report;
  const MatrixXd weights = boundedBiharmonicWeights(laplacian, {{1500, 1501}, {3}}, {}, &report);
  support::expectCopies(laplacian, weights);
  EXPECT_TRUE(weights.topRows(1000).allFinite());
  EXPECT_EQ(weights(7, 0), 1);
  EXPECT_TRUE(weights.middleRows(1000, 500).array().isNaN().all());
  EXPECT_TRUE(weights.bottomRows(2).array().isNaN().all());
  EXPECT_EQ(report.not_reached, weights.col(0).array().isNaN().count());
  // Handles on both components: each knows only its own.
  const MatrixXd both = boundedBiharmonicWeights(laplacian, {{3}, {9}, {1200}});
  EXPECT_TRUE(both.topRows(1000).col(2).isZero(0));
  EXPECT_TRUE((both.middleRows(1000, 500).col(2).array() == 1).all());
}

TEST(BoundedWeights, OfOddMeshesAreDefined) {
  for (const shapes::Mesh& mesh : {shapes::slivers(8), shapes::zeroLengthEdges(6), shapes::repeatedVertices(6),
                                   shapes::duplicateTriangles(6), shapes::bowTieCones(5), shapes::moebius(6),
                                   shapes::kleinBottle(8), shapes::book(3, 4), shapes::tetrahedron()}) {
    const std::vector<std::vector<int>> handles = {{0}, {3}};
    WeightReport report;
    const MatrixXd weights = boundedBiharmonicWeights(meshLaplacian(mesh.points, mesh.triangles), handles, {}, &report);
    expectWeights(weights, handles);
    EXPECT_LE(report.residual, 1e-8) << mesh.name;
  }
}

TEST(BoundedWeights, NameWhatACallerGotWrong) {
  const shapes::Mesh square = shapes::gridSquare(4);
  const Laplacian laplacian = meshLaplacian(square.points, square.triangles);
  const auto why = [&](const std::vector<std::vector<int>>& handles, const WeightOptions& options = {}) {
    return refusal([&] { boundedBiharmonicWeights(laplacian, handles, options); });
  };
  EXPECT_EQ(why({}), "boundedBiharmonicWeights: handles is empty, must name at least one");
  EXPECT_EQ(why({{0}, {}}), "boundedBiharmonicWeights: handle 1 has no active point, must have at least one");
  Laplacian loose = laplacian;
  loose.status[24] = PointStatus::isolated;
  EXPECT_EQ(refusal([&] {
              boundedBiharmonicWeights(loose, {{0}, {24}}, {});
            }),
            "boundedBiharmonicWeights: handle 1 has no active point, must have at least one: point 24 is isolated");
  EXPECT_EQ(why({{0}, {25}}), "boundedBiharmonicWeights: handle 1 has point 25, must lie in [0, 25)");
  EXPECT_EQ(why({{0, 1}, {1}}), "boundedBiharmonicWeights: point 1 is of handle 0 and of handle 1, must be of one");
  EXPECT_EQ(why({{0}}, {.max_iterations = 0}), "boundedBiharmonicWeights: max_iterations = 0, must be at least 1");
  EXPECT_THROW(boundedBiharmonicWeights(laplacian, {{0}, {9}},
                                        {.solver = {.progress = [](std::string_view, double) { return false; }}}),
               Cancelled);
}

}  // namespace
}  // namespace tufted::weights_test
