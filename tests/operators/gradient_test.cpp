// Gradients per point: exact on planes, close on curved surfaces, defined everywhere.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "shapes/shapes.h"
#include "support/odd_cloud.h"
#include "tufted/tufted.h"

namespace tufted::gradient_test {
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
  EXPECT_LE((found.rowwise() - slope).cwiseAbs().maxCoeff(), 1e-12);

  const shapes::Mesh mesh = shapes::gridSquare(20);
  const Gradients of_mesh =
      gradients(meshLaplacian(mesh.points, mesh.triangles), mesh.points, meshFrames(mesh.points, mesh.triangles));
  EXPECT_LE((inSpace(of_mesh, mesh.points * slope.transpose()).rowwise() - slope).cwiseAbs().maxCoeff(), 1e-12);
}

/// How far the gradients of x, y and z are from the parts of the axes that lie in the planes, root mean square of two
/// directions.
VectorXd coordinateErrors(const Gradients& gradients, const Points& points) {
  const Eigen::MatrixX3d x = gradients.X * points, y = gradients.Y * points;
  VectorXd errors(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::RowVector3d normal = gradients.frames.normals.row(i), tangent = gradients.frames.tangents.row(i);
    errors[i] = std::hypot((x.row(i) - tangent).norm(), (y.row(i) - normal.cross(tangent)).norm()) / std::sqrt(2);
  }
  return errors;
}

TEST(Gradients, OfCoordinatesAreTheAxesInThePlanes) {
  for (const double noise : {0.0, 0.02}) {
    const Points points = shapes::withNoise(shapes::torus(3000), noise).points;
    const Laplacian laplacian = pointCloudLaplacian(points);
    for (const int neighbors : {0, 8, 30, 100}) {
      const Gradients found = gradients(laplacian, points, {.neighbors = neighbors});
      EXPECT_LE(coordinateErrors(found, points).maxCoeff(), 1e-9) << neighbors;
      EXPECT_GE(found.frames.normals.cwiseProduct(laplacian.frames.normals).rowwise().sum().minCoeff(), 0);
    }
  }
}

/// sin 2x + y z and its gradient on the unit sphere.
double wave(const Eigen::RowVector3d& p) {
  return std::sin(2 * p.x()) + p.y() * p.z();
}
Eigen::RowVector3d slopeOfWave(const Eigen::RowVector3d& p) {
  const Eigen::RowVector3d slope(2 * std::cos(2 * p.x()), p.z(), p.y());
  return slope - slope.dot(p) * p;
}

/// The median length of the error of wave's gradient, whose values are those at `exact`.
double medianError(const Gradients& gradients, const Points& exact) {
  VectorXd u(exact.rows());
  for (Eigen::Index i = 0; i < exact.rows(); ++i) u[i] = wave(exact.row(i));
  const Points found = inSpace(gradients, u);
  std::vector<double> errors;
  for (Eigen::Index i = 0; i < exact.rows(); ++i) errors.push_back((found.row(i) - slopeOfWave(exact.row(i))).norm());
  std::nth_element(errors.begin(), errors.begin() + std::ssize(errors) / 2, errors.end());
  return errors[errors.size() / 2];
}

TEST(Gradients, AreBetterWhereNoisyPointsWereMoved) {
  const Points exact = shapes::sphere(16000).points, noisy = shapes::withNoise(shapes::sphere(16000), 0.01).points;
  const Laplacian laplacian = pointCloudLaplacian(noisy);
  ASSERT_EQ(laplacian.report.denoised, 16000);
  const double moved = medianError(gradients(laplacian, laplacian.positions), exact);
  EXPECT_LE(moved, 0.82 * medianError(gradients(laplacian, noisy), exact));
}

TEST(Gradients, OnASphereFallWithTheSpacingAndWithNoise) {
  // What each error is at most: measured, and a third more.
  const Points small = shapes::sphere(2000).points, large = shapes::sphere(32000).points;
  const double coarse = medianError(gradients(pointCloudLaplacian(small), small), small);
  const double fine = medianError(gradients(pointCloudLaplacian(large), large), large);
  EXPECT_LE(coarse, 0.064);
  EXPECT_LE(fine, coarse / 3);  // order 1 in the spacing, which is a quarter
  const Points exact = shapes::sphere(16000).points, noisy = shapes::withNoise(shapes::sphere(16000), 0.01).points;
  const Laplacian laplacian = pointCloudLaplacian(noisy);
  const double wide = medianError(gradients(laplacian, noisy), exact);
  EXPECT_LE(wide, 0.1);
  EXPECT_LE(3 * wide, medianError(gradients(laplacian, noisy, laplacian.frames, {.neighbors = 0}), exact));
  const shapes::Mesh ball = shapes::icosphere(4);
  EXPECT_LE(medianError(gradients(meshLaplacian(ball.points, ball.triangles), ball.points,
                                  meshFrames(ball.points, ball.triangles)),
                        ball.points),
            0.008);
}

TEST(Gradients, OfALineScanReachOverToTheNextLine) {
  // 20 lines, 60 times as far from each other as their points, so that the nearest four lie on the same line.
  Points points(20 * 400, 3);
  for (int i = 0; i < points.rows(); ++i) {
    const int line = i / 400;
    points.row(i) << 0.01 * (i % 400), 0.6 * line, 0;
  }
  Triangles triangles(2 * 19 * 399, 3);
  int f = 0;
  for (int line = 0; line < 19; ++line) {
    for (int k = 0; k < 399; ++k) {
      const int a = 400 * line + k;
      triangles.row(f++) << a, a + 1, a + 400;
      triangles.row(f++) << a + 1, a + 401, a + 400;
    }
  }
  const Laplacian laplacian = meshLaplacian(points, triangles);
  const Gradients found = gradients(laplacian, points, meshFrames(points, triangles), {.neighbors = 4});
  EXPECT_GT(found.report.widened, 0);
  EXPECT_EQ(found.report.on_a_line, 0);
  const Eigen::RowVector3d slope(2, -3, 0);
  EXPECT_LE((inSpace(found, points * slope.transpose()).rowwise() - slope).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Gradients, WithRegularizationAreThoseOfDiffusionNet) {
  const Points points = shapes::withNoise(shapes::sphere(500), 0.02).points;
  const double added = 1e-3;
  const Gradients found = gradients(pointCloudLaplacian(points), points, {.neighbors = 30, .regularization = added});
  for (int i = 0; i < 500; i += 50) {
    const Eigen::RowVector3d normal = found.frames.normals.row(i), tangent = found.frames.tangents.row(i);
    Eigen::Matrix<double, 3, 2> axes;
    axes << tangent.transpose(), normal.cross(tangent).transpose();
    std::vector<int> others;
    const Eigen::VectorXd x = Eigen::MatrixXd(found.X).row(i), y = Eigen::MatrixXd(found.Y).row(i);
    for (int j = 0; j < 500; ++j)
      if (j != i && (x[j] != 0 || y[j] != 0)) others.push_back(j);
    ASSERT_EQ(others.size(), 30u);
    Eigen::MatrixX2d edges(30, 2);
    for (int k = 0; k < 30; ++k) edges.row(k) = (points.row(others[k]) - points.row(i)) * axes;
    const Eigen::Matrix2Xd expected =
        (edges.transpose() * edges + added * Eigen::Matrix2d::Identity()).inverse() * edges.transpose();
    for (int k = 0; k < 30; ++k) {
      EXPECT_NEAR(x[others[k]], expected(0, k), 1e-10);
      EXPECT_NEAR(y[others[k]], expected(1, k), 1e-10);
    }
    EXPECT_NEAR(x[i], -expected.row(0).sum(), 1e-10);
  }
}

TEST(Gradients, CanBeCancelled) {
  const Points points = shapes::sphere(1000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const auto stop = [](std::string_view, double) { return false; };
  EXPECT_THROW(gradients(laplacian, points, {.progress = stop}), Cancelled);
}

TEST(Divergence, IsTheAdjointOfGradients) {
  const Points points = shapes::withNoise(shapes::torus(2000), 0.02).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Gradients operators = gradients(laplacian, points);
  const VectorXd u = points.col(0).array().sin() + points.col(2).array();
  Eigen::MatrixX2d v(points.rows(), 2);
  v << points.col(1), points.col(2).array().cos();
  const VectorXd weighted_x = laplacian.M.cwiseProduct(v.col(0)), weighted_y = laplacian.M.cwiseProduct(v.col(1));
  const double by_gradient = (operators.X * u).dot(weighted_x) + (operators.Y * u).dot(weighted_y);
  const double by_divergence = -u.dot(laplacian.M.cwiseProduct(divergence(laplacian, operators, v)));
  EXPECT_NEAR(by_gradient, by_divergence, 1e-11 * std::abs(by_gradient));
}

TEST(Divergence, OfTheGradientOfAHeightOnASphere) {
  // The Laplacian of z is -2 z.
  const Points points = shapes::sphere(8000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Gradients operators = gradients(laplacian, points);
  Eigen::MatrixX2d v(points.rows(), 2);
  v << operators.X * points.col(2), operators.Y * points.col(2);
  const VectorXd found = divergence(laplacian, operators, v);
  EXPECT_LE(std::abs(laplacian.M.dot(found)), 1e-12);
  // Pointwise it wavers with the samples; over a cap it is what flows out.
  const VectorXd smooth = (1 - points.col(2).array()).exp();
  EXPECT_NEAR(smooth.dot(laplacian.M.cwiseProduct(found)), -2 * smooth.dot(laplacian.M.cwiseProduct(points.col(2))),
              0.02 * 4 * std::acos(-1.0));
}

TEST(Divergence, TreatsOddPointsAsTheyAre) {
  Points points(1002, 3);
  points.topRows(1000) = shapes::sphere(1000).points;
  points.row(1000) = points.row(8);
  points.row(1001).setConstant(NAN);
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Gradients operators = gradients(laplacian, points);
  Eigen::MatrixX2d v = Eigen::MatrixX2d::Ones(1002, 2);
  v.row(1001).setConstant(NAN);
  const VectorXd found = divergence(laplacian, operators, v);
  EXPECT_TRUE(found.allFinite());
  EXPECT_EQ(found[1000], found[8]);
  EXPECT_EQ(found[1001], 0);
  v(3, 1) = NAN;
  EXPECT_THROW(divergence(laplacian, operators, v), InvalidInput);
  EXPECT_THROW(divergence(laplacian, operators, v.topRows(5)), InvalidInput);
}

TEST(Gradients, OfConstantsVanish) {
  const Points points = shapes::withNoise(shapes::torus(3000), 0.02).points;
  const Gradients operators = gradients(pointCloudLaplacian(points), points);
  const VectorXd ones = VectorXd::Ones(points.rows());
  EXPECT_LE((operators.X * ones).cwiseAbs().maxCoeff(), 1e-12 * operators.X.coeffs().abs().maxCoeff());
  EXPECT_LE((operators.Y * ones).cwiseAbs().maxCoeff(), 1e-12 * operators.Y.coeffs().abs().maxCoeff());
}

TEST(Gradients, HaveFramesAtOddPoints) {
  const Points points = support::oddCloud();
  const Frames frames = gradients(pointCloudLaplacian(points), points).frames;
  for (int i = 0; i < points.rows(); ++i) {
    EXPECT_NEAR(frames.normals.row(i).norm(), 1, 1e-12);
    EXPECT_NEAR(frames.normals.row(i).dot(frames.tangents.row(i)), 0, 1e-12);
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

TEST(MeshFrames, EndWhereAreasOverflow) {
  const shapes::Mesh ball = shapes::icosphere(1);
  for (const double size : {1e-320, 1e-160, 1e160, 1.2e308}) {
    const Frames frames = meshFrames(size * ball.points, ball.triangles);
    EXPECT_NEAR(frames.normals.rowwise().norm().minCoeff(), 1, 1e-12) << size;
  }
}

TEST(MeshFrames, DoNotDependOnOrientation) {
  const shapes::Mesh one = shapes::gridSquare(16), mixed = shapes::mixedOrientation(16);
  const Frames frames = meshFrames(mixed.points, mixed.triangles);
  EXPECT_LE((frames.normals.col(2).cwiseAbs().array() - 1).abs().maxCoeff(), 1e-12);
  const shapes::Mesh ball = shapes::icosphere(3);
  const Frames outward = meshFrames(ball.points, ball.triangles);
  EXPECT_GE((outward.normals.cwiseProduct(ball.points)).rowwise().sum().minCoeff(), 0.999);
  EXPECT_EQ(outward.orientation, Orientation::given);
  EXPECT_EQ(frames.orientation, Orientation::arbitrary);
  EXPECT_EQ(meshFrames(one.points, Triangles(0, 3)).normals.col(2).minCoeff(), 1);
}

TEST(Gradients, NameWhatACallerGotWrong) {
  const shapes::Mesh ball = shapes::icosphere(1);
  const Laplacian laplacian = meshLaplacian(ball.points, ball.triangles);
  const Frames frames = meshFrames(ball.points, ball.triangles);
  EXPECT_THROW(gradients(laplacian, ball.points), InvalidInput);
  EXPECT_THROW(gradients(laplacian, ball.points.topRows(3), frames), InvalidInput);
  EXPECT_THROW(gradients(laplacian, ball.points, {frames.normals.topRows(3), frames.tangents}), InvalidInput);
  for (const int neighbors : {-1, 1, 2, 10'001})
    EXPECT_THROW(gradients(laplacian, ball.points, frames, {.neighbors = neighbors}), InvalidInput) << neighbors;
  for (const double added : {-1.0, double{INFINITY}, double{NAN}})
    EXPECT_THROW(gradients(laplacian, ball.points, frames, {.regularization = added}), InvalidInput) << added;
  EXPECT_THROW(gradients(laplacian, ball.points, frames, {.threads = -1}), InvalidInput);
  EXPECT_THROW(meshFrames(ball.points, Triangles{{0, 1, 100}}), InvalidInput);
  EXPECT_EQ(gradients(pointCloudLaplacian(Points(0, 3)), Points(0, 3)).X.rows(), 0);
}

}  // namespace
}  // namespace tufted::gradient_test
