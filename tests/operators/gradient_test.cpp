// Gradients per point: exact on planes, close on curved surfaces, defined everywhere.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted {
namespace {

/// The gradient as a vector in space.
Points inSpace(const Gradients& gradients, const VectorXd& u) {
  const VectorXd x = gradients.X * u, y = gradients.Y * u;
  Points result(u.size(), 3);
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const Eigen::RowVector3d normal = gradients.frames.normals.row(i), tangent = gradients.frames.tangents.row(i);
    result.row(i) = x[i] * tangent + y[i] * normal.cross(tangent);
  }
  return result;
}

TEST(Gradients, AreExactForLinearFunctionsOnAPlane) {
  const Points points = shapes::square(2000, shapes::Sampling::jittered, shapes::Rim::included).points;
  const Eigen::RowVector3d slope(2, -3, 0);
  const VectorXd u = points * slope.transpose();
  const Points found = inSpace(gradients(pointCloudLaplacian(points), points), u);
  EXPECT_LE((found.rowwise() - slope).cwiseAbs().maxCoeff(), 1e-9);

  const shapes::Mesh mesh = shapes::gridSquare(20);
  const Gradients of_mesh =
      gradients(meshLaplacian(mesh.points, mesh.triangles), mesh.points, meshFrames(mesh.points, mesh.triangles));
  EXPECT_LE((inSpace(of_mesh, mesh.points * slope.transpose()).rowwise() - slope).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Gradients, MeetThoseOfCoordinatesOnASphere) {
  // The gradient of z is e_z without its part along the normal.
  const auto error = [](const Points& points, const Gradients& operators) {
    Points exact(points.rows(), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      exact.row(i) = Eigen::RowVector3d::UnitZ() - points(i, 2) * points.row(i);
    }
    return (inSpace(operators, points.col(2)) - exact).norm() / exact.norm();
  };
  const Points small = shapes::sphere(2000).points, large = shapes::sphere(32000).points;
  const double coarse = error(small, gradients(pointCloudLaplacian(small), small));
  const double fine = error(large, gradients(pointCloudLaplacian(large), large));
  EXPECT_LE(coarse, 0.05);
  EXPECT_LE(fine, coarse / 3);  // order 1 in the spacing, which is a quarter
  const shapes::Mesh ball = shapes::icosphere(4);
  EXPECT_LE(error(ball.points, gradients(meshLaplacian(ball.points, ball.triangles), ball.points,
                                         meshFrames(ball.points, ball.triangles))),
            0.02);
}

TEST(Gradients, OfConstantsVanish) {
  const Points points = shapes::withNoise(shapes::torus(3000), 0.02).points;
  const Gradients operators = gradients(pointCloudLaplacian(points), points);
  const VectorXd ones = VectorXd::Ones(points.rows());
  EXPECT_LE((operators.X * ones).cwiseAbs().maxCoeff(), 1e-12 * operators.X.coeffs().abs().maxCoeff());
  EXPECT_LE((operators.Y * ones).cwiseAbs().maxCoeff(), 1e-12 * operators.Y.coeffs().abs().maxCoeff());
}

TEST(Gradients, AreDefinedForOddPoints) {
  Points points(1003, 3);
  points.topRows(1000) = shapes::sphere(1000).points;
  points.row(1000) = points.row(8);
  points.row(1001).setConstant(NAN);
  points.row(1002) << 1e6, 0, 0;
  const Gradients operators = gradients(pointCloudLaplacian(points), points);
  const auto row = [](const SparseMatrix& A, int i) { return Eigen::RowVectorXd(Eigen::MatrixXd(A).row(i)); };
  EXPECT_EQ(row(operators.X, 1000), row(operators.X, 8));
  EXPECT_EQ(row(operators.Y, 1000), row(operators.Y, 8));
  for (const int i : {1001, 1002}) EXPECT_TRUE(row(operators.X, i).isZero(0) && row(operators.Y, i).isZero(0));
  EXPECT_TRUE(operators.X.coeffs().allFinite() && operators.Y.coeffs().allFinite());
  for (int i = 0; i < 1003; ++i) {
    EXPECT_NEAR(operators.frames.normals.row(i).norm(), 1, 1e-12);
    EXPECT_NEAR(operators.frames.normals.row(i).dot(operators.frames.tangents.row(i)), 0, 1e-12);
  }
}

TEST(Gradients, AcrossALineAreZero) {
  // Triangles that stand on edge: in the frames given here all neighbours lie on one line.
  const Points points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 1}};
  const Laplacian laplacian = meshLaplacian(points, Triangles{{0, 1, 3}, {1, 2, 3}});
  Frames frames{Points(4, 3), Points(4, 3)};
  frames.normals.rowwise() = Eigen::RowVector3d(0, 0, 1);
  frames.tangents.rowwise() = Eigen::RowVector3d(1, 0, 0);
  const Gradients operators = gradients(laplacian, points, frames);
  EXPECT_LE((operators.X * points.col(0) - VectorXd::Ones(4)).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ((operators.Y * VectorXd(points.col(0))).cwiseAbs().maxCoeff(), 0);
}

TEST(MeshFrames, DoNotDependOnOrientation) {
  const shapes::Mesh one = shapes::gridSquare(16), mixed = shapes::mixedOrientation(16);
  const Frames frames = meshFrames(mixed.points, mixed.triangles);
  EXPECT_LE((frames.normals.col(2).cwiseAbs().array() - 1).abs().maxCoeff(), 1e-12);
  const shapes::Mesh ball = shapes::icosphere(3);
  const Frames outward = meshFrames(ball.points, ball.triangles);
  EXPECT_GE((outward.normals.cwiseProduct(ball.points)).rowwise().sum().minCoeff(), 0.999);
  EXPECT_EQ(meshFrames(one.points, Triangles(0, 3)).normals.col(2).minCoeff(), 1);
}

TEST(Gradients, NameWhatACallerGotWrong) {
  const shapes::Mesh ball = shapes::icosphere(1);
  const Laplacian laplacian = meshLaplacian(ball.points, ball.triangles);
  const Frames frames = meshFrames(ball.points, ball.triangles);
  EXPECT_THROW(gradients(laplacian, ball.points), InvalidInput);
  EXPECT_THROW(gradients(laplacian, ball.points.topRows(3), frames), InvalidInput);
  EXPECT_THROW(gradients(laplacian, ball.points, {frames.normals.topRows(3), frames.tangents}), InvalidInput);
  EXPECT_THROW(meshFrames(ball.points, Triangles{{0, 1, 100}}), InvalidInput);
  EXPECT_EQ(gradients(pointCloudLaplacian(Points(0, 3)), Points(0, 3)).X.rows(), 0);
}

}  // namespace
}  // namespace tufted
