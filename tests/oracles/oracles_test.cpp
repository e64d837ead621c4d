#include "oracles/oracles.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "oracles/classic_heat.h"
#include "oracles/geodesics.h"
#include "oracles/planar.h"
#include "shapes/random.h"
#include "shapes/shapes.h"

namespace tufted::oracles::oracles_test {
namespace {

using shapes::Sampling;

TEST(Hull, OfSpherePointsIsATriangulatedSphere) {
  const shapes::Cloud cloud = shapes::sphere(1000);
  const Triangles hull = convexHullMesh(cloud.points);
  const Topology found = topology(hull);
  EXPECT_EQ(hull.rows(), 2 * 1000 - 4);
  EXPECT_EQ(found.euler, 2);
  EXPECT_EQ(found.boundary_edges, 0);
  EXPECT_NEAR(surfaceArea(cloud.points, hull), cloud.area, 0.02 * cloud.area);
  for (Eigen::Index f = 0; f < hull.rows(); ++f) {
    const Eigen::RowVector3d a = cloud.points.row(hull(f, 0)), b = cloud.points.row(hull(f, 1)),
                             c = cloud.points.row(hull(f, 2));
    EXPECT_GT(a.dot(b.cross(c)), 0);
  }
}

// The error is of second order: it falls by four when the number of points grows by four.
TEST(Eigenvalues, OfTheHullConvergeToTheSphere) {
  for (const auto& [n, expected] : {std::pair(1000, 4.2e-2), std::pair(4000, 1.0e-2), std::pair(16000, 2.5e-3)}) {
    const shapes::Cloud cloud = shapes::sphere(n);
    const Operators operators = cotanLaplacian(cloud.points, convexHullMesh(cloud.points));
    const double error = meanRelativeError(smallestEigenvalues(operators.L, operators.M, 49), cloud.eigenvalues);
    EXPECT_NEAR(error, expected, 0.15 * expected) << n;
  }
}

TEST(Eigenvalues, OfMeshesConvergeToTheirTruth) {
  for (const shapes::Mesh& mesh : {shapes::gridSquare(40), shapes::icosphere(4), shapes::book(3, 24),
                                   shapes::book(5, 24), shapes::mixedOrientation(40)}) {
    const Operators operators = cotanLaplacian(mesh.points, mesh.triangles);
    const VectorXd values = smallestEigenvalues(operators.L, operators.M, 20);
    EXPECT_LT(meanRelativeError(values, mesh.eigenvalues), 2e-2) << mesh.name;
  }
}

// The numeric entries of the cube's table are compared with a Richardson extrapolation of second order.
TEST(Eigenvalues, OfTheCubeExtrapolateToItsTable) {
  const auto values = [](int n) {
    const shapes::Mesh mesh = shapes::cubeQuads(n);
    const Operators operators = cotanLaplacian(mesh.points, mesh.triangles);
    return smallestEigenvalues(operators.L, operators.M, 50);
  };
  const VectorXd table = shapes::cubeQuads(1).eigenvalues, extrapolated = (4 * values(40) - values(20)) / 3;
  ASSERT_EQ(table.size(), 50);
  for (int i = 1; i < 50; ++i) EXPECT_NEAR(extrapolated[i] / table[i], 1, 2e-3) << i;
}

TEST(Eigenvalues, AreMOrthonormalAndSolveTheProblem) {
  const shapes::Mesh mesh = shapes::icosphere(3);
  const auto [L, M] = cotanLaplacian(mesh.points, mesh.triangles);
  const Spectrum spectrum = smallestEigenpairs(L, M, 30);
  const Eigen::MatrixXd gram = spectrum.vectors.transpose() * M.asDiagonal() * spectrum.vectors;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(30, 30)).cwiseAbs().maxCoeff(), 1e-8);
  const Eigen::MatrixXd residual =
      L * spectrum.vectors - M.asDiagonal() * spectrum.vectors * spectrum.values.asDiagonal();
  EXPECT_LT(residual.cwiseAbs().maxCoeff(), 1e-8);
}

// Six equal components have multiple eigenvalues, of which Krylov methods miss some.
TEST(Eigenvalues, OfEqualComponentsAreAllFound) {
  const shapes::Mesh one = shapes::gridSquare(8);
  constexpr int copies = 6;
  const Eigen::Index n = one.points.rows(), faces = one.triangles.rows();
  Points points(copies * n, 3);
  Triangles triangles(copies * faces, 3);
  for (int copy = 0; copy < copies; ++copy) {
    points.middleRows(copy * n, n) = one.points.rowwise() + Eigen::RowVector3d(2.0 * copy, 0, 0);
    triangles.middleRows(copy * faces, faces) = one.triangles.array() + static_cast<int>(copy * n);
  }
  const Operators single = cotanLaplacian(one.points, one.triangles), all = cotanLaplacian(points, triangles);
  const VectorXd values = smallestEigenvalues(single.L, single.M, 5), found = smallestEigenvalues(all.L, all.M, 30);
  for (int i = 0; i < 30; ++i) EXPECT_NEAR(found[i], values[i / copies], 1e-8) << i;
}

TEST(Eigenvalues, IgnoreInactivePointsAndScale) {
  const shapes::Mesh mesh = shapes::gridSquare(10), padded = shapes::unreferencedVertices(10);
  const Operators plain = cotanLaplacian(mesh.points, mesh.triangles),
                  other = cotanLaplacian(padded.points * 1024, padded.triangles);
  const VectorXd a = smallestEigenvalues(plain.L, plain.M, 10), b = smallestEigenvalues(other.L, other.M, 10);
  EXPECT_LT((a - b * 0x1p20).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(Cotan, RepeatedTrianglesWithoutAreaAreSkipped) {
  const shapes::Mesh mesh = shapes::gridSquare(6), repeated = shapes::repeatedVertices(6);
  const Operators a = cotanLaplacian(mesh.points, mesh.triangles),
                  b = cotanLaplacian(repeated.points, repeated.triangles);
  EXPECT_EQ((a.L - b.L).norm(), 0);
  EXPECT_NEAR(a.M.sum(), 1, 1e-12);
}

TEST(DelaunayStar, HasEmptyCircles) {
  shapes::Random random(4);
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> points(200, 2);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    points(i, 0) = random.normal();
    points(i, 1) = random.normal();
  }
  const PlanarStar star = delaunayStarOracle(points);
  ASSERT_TRUE(star.closed);
  for (const auto& [i, j] : star.triangles) {
    // Circle through the origin, a and b: 2 c.p = |p|^2 for both.
    Eigen::Matrix2d sides;
    sides << points.row(i), points.row(j);
    const Eigen::Vector2d centre =
        sides.inverse() * Eigen::Vector2d(points.row(i).squaredNorm(), points.row(j).squaredNorm()) / 2;
    for (Eigen::Index k = 0; k < points.rows(); ++k) {
      EXPECT_GE((points.row(k).transpose() - centre).norm(), centre.norm() * (1 - 1e-9));
    }
  }
}

TEST(ExactDistances, AreStraightOnAPlane) {
  const shapes::Mesh square = shapes::gridSquare(12);
  // Different weights, so that confused corners are detected.
  const std::array<double, 3> weights = {0.7, 0.2, 0.1};
  for (const int face : {0, 77}) {
    Eigen::RowVector3d source = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) source += weights[k] * square.points.row(square.triangles(face, k));
    const VectorXd distance = *exactDistances(square.points, square.triangles, face, weights);
    const VectorXd straight = (square.points.rowwise() - source).rowwise().norm();
    EXPECT_LE((distance - straight).cwiseAbs().maxCoeff(), 1e-12);
  }
  const shapes::Mesh book = shapes::book(3, 4);
  EXPECT_FALSE(exactDistances(book.points, book.triangles, 0, weights).has_value());
}

TEST(StretchedDelaunay, CoversTheSquareWithAllPoints) {
  for (const double stretch : {1.0, 8.0}) {
    const PlanarMesh mesh = obtuseSquare(300, stretch, 5);
    EXPECT_NEAR(surfaceArea(mesh.points, mesh.triangles), 1, 1e-12);
    EXPECT_EQ(mesh.triangles.rows(), 2 * 304 - 2 - 4);  // Euler, 4 points on the boundary
    EXPECT_EQ(topology(mesh.triangles).boundary_edges, 4);
  }
}

TEST(BadBook, UnfoldsPageByPage) {
  const Book book = badBook(3, 10, 4, 2);
  EXPECT_NEAR(surfaceArea(book.points, book.triangles), 3, 1e-12);
  EXPECT_EQ(topology(book.triangles).nonmanifold_edges, 10);
  const VectorXd distance = bookDistances(book, 40);
  for (Eigen::Index i = 0; i < distance.size(); ++i) {
    const double straight = (book.points.row(i) - book.points.row(40)).norm();
    EXPECT_GE(distance[i], straight * (1 - 1e-14));
    if (book.page[i] < 0 || book.page[i] == book.page[40]) {
      EXPECT_NEAR(distance[i], straight, 1e-14);
    }
  }
}

TEST(ClassicHeat, MeetsExactDistancesOnAGoodMesh) {
  const shapes::Mesh ball = shapes::icosphere(4);
  const VectorXd exact = *exactDistances(ball.points, ball.triangles, 0, {1, 0, 0});
  const VectorXd heat = classicHeatDistances(ball.points, ball.triangles, ball.triangles(0, 0));
  EXPECT_LE((heat - exact).cwiseAbs().sum() / exact.sum(), 0.03);
}

}  // namespace
}  // namespace tufted::oracles::oracles_test
