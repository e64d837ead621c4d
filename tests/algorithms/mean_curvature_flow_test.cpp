// The conformalised mean curvature flow: spheres, components, units, and what callers get wrong.
#include "tufted/mean_curvature_flow.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "shapes/shapes.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::mean_curvature_flow_test {
namespace {

/// An icosphere with other lengths of axes and a dent.
shapes::Mesh egg(int subdivisions = 3) {
  shapes::Mesh mesh = shapes::icosphere(subdivisions);
  mesh.points = mesh.points * Eigen::DiagonalMatrix<double, 3>(2, 1, 0.7);
  mesh.points.col(2) -= 0.2 * mesh.points.col(0).cwiseAbs2();
  return mesh;
}

Points flowed(const shapes::Mesh& mesh, const MeanCurvatureFlowOptions& options = {}) {
  return meanCurvatureFlow(meshLaplacian(mesh.points, mesh.triangles), mesh.triangles, options);
}

/// The standard deviation of the distances from the middle over their mean, and this mean.
std::pair<double, double> roundness(const Points& points) {
  const Eigen::RowVector3d middle = points.colwise().mean();
  const VectorXd radii = (points.rowwise() - middle).rowwise().norm();
  return {std::sqrt((radii.array() - radii.mean()).square().mean()) / radii.mean(), radii.mean()};
}

TEST(MeanCurvatureFlow, MakesASphereOfTheSameArea) {
  const shapes::Mesh mesh = egg();
  const double area = meshLaplacian(mesh.points, mesh.triangles).M.sum();
  EXPECT_GT(roundness(mesh.points).first, 0.25);
  const Points moved = flowed(mesh, {.time_step = 0.05, .steps = 30});
  const auto [deviation, radius] = roundness(moved);
  EXPECT_LT(deviation, 0.02);
  EXPECT_NEAR(4 * M_PI * radius * radius, area, 0.04 * area);
  EXPECT_NEAR(meshLaplacian(moved, mesh.triangles).M.sum(), area, 1e-9 * area);
}

TEST(MeanCurvatureFlow, MovesEachComponentAsIfItWereAlone) {
  const shapes::Mesh mesh = egg();
  const Eigen::Index n = mesh.points.rows(), f = mesh.triangles.rows();
  shapes::Mesh both;
  both.points.resize(2 * n + 1, 3);
  both.points.topRows(n) = mesh.points;
  both.points.middleRows(n, n) = (1e-3 * mesh.points).rowwise() + Eigen::RowVector3d(30, 0, 0);
  both.points.row(2 * n).setConstant(NAN);
  both.triangles.resize(2 * f, 3);
  both.triangles << mesh.triangles, mesh.triangles.array() + static_cast<int>(n);
  const Points alone = flowed(mesh), moved = flowed(both);
  EXPECT_LT((moved.topRows(n) - alone).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(((moved.middleRows(n, n).rowwise() - Eigen::RowVector3d(30, 0, 0)) - 1e-3 * alone).cwiseAbs().maxCoeff(),
            1e-9);
  EXPECT_TRUE(moved.row(2 * n).array().isNaN().all());
}

TEST(MeanCurvatureFlow, IsTheSameByMultigrid) {
  const shapes::Mesh mesh = egg();
  MeanCurvatureFlowOptions options = {.steps = 3};
  const Points expected = flowed(mesh, options);
  options.solver.method = SolverMethod::multigrid;
  EXPECT_LT((flowed(mesh, options) - expected).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(MeanCurvatureFlow, HasTheSameBitsInAnyUnitThatIsAPowerOfTwo) {
  const shapes::Mesh mesh = egg(2);
  const Points expected = flowed(mesh, {.steps = 3});
  for (const int exponent : {-400, 30, 400}) {
    shapes::Mesh scaled = mesh;
    scaled.points *= std::ldexp(1, exponent);
    EXPECT_EQ(flowed(scaled, {.steps = 3}), std::ldexp(1, exponent) * expected) << exponent;
  }
}

TEST(MeanCurvatureFlow, LeavesPointsWithoutAreaInPlace) {
  Points line(3, 3);
  line << 0, 0, 0, 1, 0, 0, 2, 0, 0;
  Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  const Laplacian laplacian = meshLaplacian(line, triangles, {.mollify = 0});
  EXPECT_EQ(meanCurvatureFlow(laplacian, triangles), line);
  EXPECT_EQ(meanCurvatureFlow(laplacian, Triangles(0, 3)), line);
}

TEST(MeanCurvatureFlow, NamesWhatACallerGotWrong) {
  const shapes::Mesh mesh = egg(1);
  const auto refused = [&](const MeanCurvatureFlowOptions& options) {
    return support::refusal([&] { flowed(mesh, options); });
  };
  EXPECT_EQ(refused({.time_step = 0}), "meanCurvatureFlow: time_step = 0, must lie in [1e-200, 1e200]");
  EXPECT_EQ(refused({.steps = 0}), "meanCurvatureFlow: steps = 0, must be at least 1");
  EXPECT_THROW(flowed(mesh, {.time_step = 1e100}), SolverFailure);
  Triangles beyond = mesh.triangles;
  beyond(2, 1) = 42;
  EXPECT_EQ(support::refusal([&] { meanCurvatureFlow(meshLaplacian(mesh.points, mesh.triangles), beyond); }),
            "meanCurvatureFlow: triangle 2 has the corner 42, must lie in [0, 42)");
}

}  // namespace
}  // namespace tufted::mean_curvature_flow_test
