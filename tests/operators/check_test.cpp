// The figures of validate. That it finds what is broken is in guarantees/planted_test.cpp.
#include "tufted/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string_view>

#include "shapes/shapes.h"
#include "tufted/errors.h"
#include "tufted/gradient.h"

namespace tufted::check_test {
namespace {

/// A sphere of 500 points, then a point that is not finite and a copy of point 7.
Laplacian sphereWithOddPoints(bool keep_cover = true) {
  Points points(502, 3);
  points.topRows(500) = shapes::sphere(500).points.topRows(500);
  points.row(500).setConstant(NAN);
  points.row(501) = points.row(7);
  return pointCloudLaplacian(points, {.keep_cover = keep_cover});
}

struct Edge {
  int a, b;
  double weight;
};

/// The Laplacian of a graph on n vertices, with a report that agrees.
Laplacian graphLaplacian(int n, const std::vector<Edge>& edges, int components) {
  Laplacian laplacian;
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
  for (const auto& [a, b, weight] : edges) {
    L(a, b) -= weight, L(b, a) -= weight;
    L(a, a) += weight, L(b, b) += weight;
  }
  laplacian.L = L.sparseView(0, 0);
  laplacian.L.makeCompressed();
  laplacian.M = VectorXd::Ones(n);
  laplacian.status.assign(n, PointStatus::active);
  for (int i = 0; i < n; ++i) laplacian.representative.push_back(i);
  laplacian.boundary.assign(n, Boundary::none);
  laplacian.report.points = laplacian.report.active = n;
  laplacian.report.nonzeros = laplacian.L.nonZeros();
  laplacian.report.components = components;
  return laplacian;
}

TEST(LaplacianCheck, CountsPointsEntriesAndComponents) {
  const Laplacian laplacian = sphereWithOddPoints();
  const LaplacianCheck check = validate(laplacian);
  EXPECT_EQ(check.status, (std::array<std::int64_t, 4>{500, 1, 1, 0}));
  EXPECT_EQ(check.components, 1);
  EXPECT_DOUBLE_EQ(check.nonzeros_per_row, static_cast<double>(laplacian.L.nonZeros()) / 500);
  EXPECT_EQ(check.symmetry_error, 0);
  EXPECT_LT(check.row_sum_error, 1e-14);
  EXPECT_TRUE(check.definite);
  ASSERT_TRUE(check.cover.has_value());
  EXPECT_TRUE(check.cover->ok());
  ASSERT_TRUE(check.surface.has_value());
  EXPECT_LT(check.surface->weight_error, 1e-14);
  EXPECT_LT(check.surface->area_error, 1e-14);
  EXPECT_TRUE(check.surface->masses_compared);
  EXPECT_LT(check.surface->mass_error, 1e-14);
  EXPECT_EQ(check.surface->coarse_points, 0);
  EXPECT_EQ(check.not_checked, std::vector<std::string>());
  EXPECT_TRUE(check.ok());
}

TEST(LaplacianCheck, LooksAtTheCoverOnlyWhereItIsKept) {
  const LaplacianCheck check = validate(sphereWithOddPoints(false));
  EXPECT_FALSE(check.cover.has_value());
  EXPECT_FALSE(check.surface.has_value());
  EXPECT_EQ(check.not_checked,
            (std::vector<std::string>{"surface: L and M were not compared with the cover, which is not kept"}));
  EXPECT_TRUE(check.ok());
}

TEST(LaplacianCheck, OfCloudsAndOfThemAloneItExpectsFrames) {
  Laplacian cloud = sphereWithOddPoints();
  cloud.frames = {};
  EXPECT_EQ(validate(cloud).faults, (std::vector<std::string>{"size: 2 times, first 0 normals for 502 points"}));
  const shapes::Mesh ball = shapes::icosphere(2);
  Laplacian mesh = meshLaplacian(ball.points, ball.triangles);
  EXPECT_TRUE(validate(mesh).ok());
  mesh.frames = meshFrames(ball.points, ball.triangles);
  EXPECT_TRUE(validate(mesh).ok());
  mesh.frames.normals.conservativeResize(5, Eigen::NoChange);
  EXPECT_FALSE(validate(mesh).ok());
}

TEST(LaplacianCheck, MeasuresErrorsAgainstTheDiagonal) {
  Laplacian laplacian = graphLaplacian(3, {{0, 1, 3e5}, {1, 2, 1e5}}, 1);
  laplacian.L.coeffRef(2, 1) = -1.5e5;
  const LaplacianCheck check = validate(laplacian);
  EXPECT_DOUBLE_EQ(check.symmetry_error, 0.5e5 / 4e5);
  EXPECT_DOUBLE_EQ(check.row_sum_error, 0.5e5 / 1e5);
  EXPECT_EQ(check.faults, (std::vector<std::string>{"symmetry: L(2, 1) = -150000, L(1, 2) = -100000",
                                                    "row sum: row 2 sums to -50000 beside a diagonal of 100000",
                                                    "definite: L + 1e-12 diag(L) has no Cholesky factor"}));
}

TEST(LaplacianCheck, SaysHowOftenAndWhereFirst) {
  const Laplacian laplacian = graphLaplacian(4, {{0, 1, 1}, {1, 2, -1e-3}, {2, 3, 1}}, 1);
  const LaplacianCheck check = validate(laplacian);
  EXPECT_EQ(check.positive_off_diagonals, 2);
  ASSERT_FALSE(check.ok());
  EXPECT_EQ(check.faults.front(), "off-diagonal sign: 2 times, first L(2, 1) = 0.001");
}

TEST(LaplacianCheck, AcceptsWeightsOfVeryDifferentMagnitude) {
  const LaplacianCheck check = validate(graphLaplacian(4, {{0, 1, 1e-300}, {1, 2, 1}, {2, 3, 1e300}}, 1));
  EXPECT_EQ(check.faults, std::vector<std::string>());
  EXPECT_TRUE(check.definite);
}

TEST(LaplacianCheck, JudgesAFaintComponentByItsOwnWeights) {
  Laplacian laplacian = graphLaplacian(5, {{0, 1, 1e200}, {2, 3, 1e-200}, {3, 4, 1e-200}}, 2);
  ASSERT_TRUE(validate(laplacian).ok());
  laplacian.L.coeffRef(2, 2) *= 1 - 1e-9;
  EXPECT_FALSE(validate(laplacian).definite);
}

TEST(LaplacianCheck, AreasMayUnderflowButAreCounted) {
  Points points(3, 3);
  points << 0, 0, 0, 1e-170, 0, 0, 0, 1e-170, 0;
  const LaplacianCheck check = validate(meshLaplacian(points, Triangles{{0, 1, 2}}));
  EXPECT_EQ(check.zero_masses, 3);
  EXPECT_TRUE(check.ok());
}

TEST(LaplacianCheck, NothingIsActiveInAnEmptyCloudAndThatIsFine) {
  const LaplacianCheck check = validate(pointCloudLaplacian(Points(0, 3)));
  EXPECT_EQ(check.faults, std::vector<std::string>());
  EXPECT_EQ(check.components, 0);
}

TEST(LaplacianCheck, CancelsAtEveryCall) {
  const Laplacian laplacian = sphereWithOddPoints();
  int calls = 0;
  const auto checkUntil = [&](int stop) {
    calls = 0;
    return validate(laplacian, [&](std::string_view, double fraction) {
      EXPECT_TRUE(fraction >= 0 && fraction <= 1);
      return ++calls < stop;
    });
  };
  EXPECT_TRUE(checkUntil(INT32_MAX).ok());
  const int all = calls;
  EXPECT_GE(all, 5);
  for (int stop = 1; stop <= all; ++stop) EXPECT_THROW(checkUntil(stop), Cancelled) << stop << " of " << all;
}

}  // namespace
}  // namespace tufted::check_test
