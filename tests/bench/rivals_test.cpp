#include "bench/compare/rivals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/compare/solves.h"
#include "shapes/shapes.h"
#include "shapes/spectra.h"

namespace tufted::bench::rivals_test {
namespace {

using shapes::Sampling;

/// Points of the unit square that are not near its sides.
std::vector<int> innerPoints(const Points& points) {
  std::vector<int> inner;
  for (int i = 0; i < points.rows(); ++i) {
    const auto xy = points.row(i).head<2>().array();
    if (xy.minCoeff() > 0.25 && xy.maxCoeff() < 0.75) inner.push_back(i);
  }
  return inner;
}

/// The unit square, turned and moved, so that no axis is special, and the coordinates in it.
struct Turned {
  Points flat, points;
};
Turned turnedSquare(int n) {
  const Points flat = shapes::square(n, Sampling::jittered, shapes::Rim::none, 3).points;
  Eigen::Matrix3d turn;
  turn << 2, -1, 2, 2, 2, -1, -1, 2, 2;
  const Eigen::RowVector3d shift(3, -2, 1);
  return {flat, (flat * (turn / 3).transpose()).rowwise() + shift};
}

/// The root mean squared error of L u / M on the unit sphere for u = z^2 - 1/3, whose eigenvalue is 6, over that of u.
double errorOnSphere(const CloudRival& rival, int n, int k, Sampling sampling = Sampling::lattice) {
  const Points points = shapes::sphere(n, sampling, 5).points;
  const Operators found = rival.build(points, k);
  const VectorXd u = points.col(2).array().square() - 1.0 / 3;
  const VectorXd expected = 6 * u;
  return ((found.L * u).cwiseQuotient(found.M) - expected).norm() / expected.norm();
}

CloudRival rivalNamed(const std::string& name) {
  for (const CloudRival& rival : cloudRivals())
    if (rival.name == name) return rival;
  throw std::logic_error("no rival " + name);
}

double asymmetry(const SparseMatrix& L) {
  return (L - SparseMatrix(L.transpose())).norm() / L.norm();
}

class OfEachCloudRival : public testing::TestWithParam<CloudRival> {};

TEST_P(OfEachCloudRival, RowsSumToZero) {
  const Points points = shapes::torus(800, Sampling::uniform, 3).points;
  const Operators found = GetParam().build(points, GetParam().k);
  EXPECT_LT((found.L * VectorXd::Ones(points.rows())).norm(), 1e-10 * found.L.norm());
}

TEST_P(OfEachCloudRival, IsSymmetricIfItSaysSo) {
  const double difference =
      asymmetry(GetParam().build(shapes::torus(800, Sampling::uniform, 3).points, GetParam().k).L);
  if (GetParam().symmetric)
    EXPECT_LT(difference, 1e-13);
  else
    EXPECT_GT(difference, 1e-4);
}

TEST_P(OfEachCloudRival, MassesSumToTheArea) {
  const shapes::Cloud torus = shapes::torus(4000, Sampling::uniform, 3);
  EXPECT_NEAR(GetParam().build(torus.points, GetParam().k).M.sum() / torus.area, 1, 0.03);
  const shapes::Cloud disk = shapes::disk(4000, Sampling::jittered, shapes::Rim::none, 3);
  EXPECT_NEAR(GetParam().build(disk.points, GetParam().k).M.sum() / disk.area, 1, 0.1);  // its outermost ring is lost
}

TEST_P(OfEachCloudRival, DoesNotDependOnScale) {
  const Points points = shapes::torus(800, Sampling::uniform, 3).points;
  const Operators one = GetParam().build(points, GetParam().k), large = GetParam().build(1024 * points, GetParam().k);
  EXPECT_LT((one.L - large.L).norm(), 1e-9 * one.L.norm());
  EXPECT_LT((1048576 * one.M - large.M).norm(), 1e-9 * large.M.norm());
}

INSTANTIATE_TEST_SUITE_P(Rivals, OfEachCloudRival, testing::ValuesIn(cloudRivals()), [](const auto& instance) {
  std::string name = instance.param.name;
  std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
  return name;
});

TEST(LeastSquaresRival, IsExactForQuadraticsOnAPlane) {
  const auto [flat, points] = turnedSquare(900);
  const Operators found = leastSquaresLaplacian(points, 20);
  const auto x = flat.col(0).array(), y = flat.col(1).array();
  const VectorXd u = 3 * x * x - x * y + 2 * y * y + x - 5 * y + 7;  // its Laplacian is 10
  const VectorXd value = found.L * u;
  for (int i = 0; i < u.size(); ++i) ASSERT_NEAR(value[i], -10 * found.M[i], 1e-7 * found.M[i]) << i;
}

TEST(LeastSquaresRival, ConvergesOnASphere) {
  const CloudRival rival = rivalNamed("least squares");
  // First order is what the fit gives anywhere, and second order where neighbours lie symmetrically, as on a lattice.
  EXPECT_LT(errorOnSphere(rival, 4000, 20), errorOnSphere(rival, 1000, 20) / 3);
  EXPECT_LT(errorOnSphere(rival, 4000, 20, Sampling::jittered),
            errorOnSphere(rival, 1000, 20, Sampling::jittered) / 1.7);
}

TEST(LocalCotanRivals, AreExactForLinearFunctionsInsideAPlane) {
  const auto [flat, points] = turnedSquare(900);
  const VectorXd u = 3 * flat.col(0) - 2 * flat.col(1);
  const Operators own = localCotanLaplacian(points, 30), mean = meanCotanLaplacian(points, 30);
  for (const int i : innerPoints(flat)) {
    EXPECT_NEAR((own.L * u)[i], 0, 1e-12) << i;
    EXPECT_NEAR((mean.L * u)[i], 0, 1e-12) << i;  // there all stars are those of one Delaunay triangulation
  }
}

TEST(LocalCotanRivals, AreTheCotanMatrixOfTheDelaunayTriangulationInsideAPlane) {
  const Points points = shapes::square(900, Sampling::jittered, shapes::Rim::none, 3).points;
  Points lifted = points;
  lifted.col(2) = points.leftCols<2>().rowwise().squaredNorm();
  Triangles lower(0, 3);
  const Triangles hull = oracles::convexHullMesh(lifted);
  for (const auto& t : hull.rowwise()) {
    const Eigen::RowVector3d a = points.row(t[0]), b = points.row(t[1]), c = points.row(t[2]);
    if ((b - a).head<2>().dot(Eigen::RowVector2d((c - a)[1], -(c - a)[0])) >= 0) continue;  // the upper hull
    lower.conservativeResize(lower.rows() + 1, 3);
    lower.row(lower.rows() - 1) = t;
  }
  const Operators expected = oracles::cotanLaplacian(points, lower), found = localCotanLaplacian(points, 30);
  ASSERT_FALSE(innerPoints(points).empty());
  for (const int i : innerPoints(points))
    for (const int j : innerPoints(points)) EXPECT_NEAR(found.L.coeff(i, j), expected.L.coeff(i, j), 1e-9) << i << j;
}

TEST(GaussianRivals, ConvergeOnASphere) {
  // k grows as the root of N, so that t shrinks and the number of points below the kernel grows, as the theorems ask.
  for (const char* name : {"Belkin et al.", "Liu et al."}) {
    const CloudRival rival = rivalNamed(name);
    const double coarse = errorOnSphere(rival, 500, 42, Sampling::jittered),
                 fine = errorOnSphere(rival, 4000, 120, Sampling::jittered);
    EXPECT_LT(fine, 0.6 * coarse) << name;
    EXPECT_LT(fine, 0.06) << name;
  }
}

TEST(GaussianRivals, HaveNoNegativeWeights) {
  const Points points = shapes::saddle(1000, Sampling::uniform, shapes::Rim::none, 3).points;
  for (const char* name : {"Belkin et al.", "Liu et al.", "graph, heat weights"})
    EXPECT_EQ(positiveShare(rivalNamed(name).build(points, 30).L), 0) << name;
}

TEST(GraphRival, HasTheEnergyOfCoordinates) {
  const shapes::Cloud torus = shapes::torus(2000, Sampling::uniform, 3);
  const Operators found = graphLaplacian(torus.points, 10);
  EXPECT_NEAR((torus.points.transpose() * found.L * torus.points).trace(), 2 * found.M.sum(), 1e-9);
}

TEST(IntrinsicDelaunayRival, HasNoNegativeWeightWhereCotansHave) {
  const shapes::Mesh cube = shapes::cubeMesh(6, shapes::Quality::bad, 3);
  const auto rivals = meshRivals();
  EXPECT_GT(positiveShare(rivals[0].build(cube.points, cube.triangles).L), 0.05);
  EXPECT_EQ(positiveShare(rivals[1].build(cube.points, cube.triangles).L), 0);
  EXPECT_EQ(positiveShare(rivals[2].build(cube.points, cube.triangles).L), 0);
}

TEST(Solves, FindKnownEigenvaluesWithAndWithoutSymmetry) {
  // Two tori, so that the eigenvalue 0 is double.
  const Points one = shapes::torus(600, Sampling::uniform, 3).points,
               two = shapes::torus(700, Sampling::uniform, 4).points;
  Points both(1300, 3);
  both << one, two.rowwise() + Eigen::RowVector3d(10, 0, 0);
  const Operators ours = rivalNamed("tufted, clean").build(both, 30);
  const VectorXd expected = oracles::smallestEigenvalues(ours.L, ours.M, 20);
  EXPECT_LT(expected[1], 1e-9);
  for (const bool symmetric : {true, false}) {
    const Eigenvalues found = eigenvaluesOf(ours, symmetric, 20);
    EXPECT_LT((found.values - expected).cwiseAbs().maxCoeff(), 1e-6) << symmetric;
    EXPECT_EQ(found.complex + found.negative, 0);
  }
}

TEST(Solves, CountComplexAndNegativeEigenvalues) {
  // A turn in the first two coordinates with the eigenvalues 1 +- i, and a diagonal with -3, 5, 7, ...
  constexpr int n = 40;
  Operators operators{SparseMatrix(n, n), VectorXd::Ones(n)};
  for (int i = 0; i < n; ++i) operators.L.insert(i, i) = i < 2 ? 1 : i == 2 ? -3 : 2 * i - 1;
  operators.L.insert(0, 1) = 1;
  operators.L.insert(1, 0) = -1;
  const Eigenvalues found = eigenvaluesOf(operators, false, 5);
  EXPECT_EQ(found.complex, 2);
  EXPECT_EQ(found.negative, 1);
  EXPECT_LT((found.values - (VectorXd(5) << -3, 1, 1, 5, 7).finished()).norm(), 1e-6);
}

TEST(Solves, PinnedSolutionsAreLinearOnAStrip) {
  const shapes::Mesh square = shapes::gridSquare(8);
  const SparseMatrix L = oracles::cotanLaplacian(square.points, square.triangles).L;
  Pinned pins;
  for (int i = 0; i < square.points.rows(); ++i)
    if (square.points(i, 0) == 0 || square.points(i, 0) == 1) pins.points.push_back(i);
  pins.values = square.points(pins.points, {0});
  for (const bool symmetric : {true, false}) {
    const auto u = solvePinned(L, symmetric, Eigen::MatrixXd::Zero(L.rows(), 1), pins);
    ASSERT_TRUE(u.has_value());
    EXPECT_LT((*u - square.points.col(0)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace tufted::bench::rivals_test
