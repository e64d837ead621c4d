// Multigrid on clouds of growing size.
#include <gtest/gtest.h>

#include <string>

#include "../support/resource_limit.h"
#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::solver_scaling_test {
namespace {

TEST(Multigrid, NeedsAtMost60IterationsFrom10kTo100kPoints) {
  for (const int n : {10000, 30000, 100000}) {
    const Laplacian laplacian = pointCloudLaplacian(shapes::torus(n).points, {.keep_cover = false});
    const SolverOptions options = {.method = SolverMethod::multigrid, .tolerance = 1e-10, .max_iterations = 60};
    SolveReport report;
    Solver::laplacian(laplacian, options).solve(VectorXd::Unit(n, n / 2), &report);
    EXPECT_LE(report.residual, 1.5e-10) << n;
    EXPECT_LE(report.iterations, 60) << n;
    SparseMatrix A = laplacian.L;
    for (int i = 0; i < n; ++i) A.coeffRef(i, i) += laplacian.M[i] / laplacian.report.mean_squared_edge;
    Solver::positiveDefinite(A, options).solve(VectorXd::Unit(n, n / 2), &report);
    EXPECT_LE(report.residual, 1.5e-10) << n;
  }
}

TEST(Solver, FailsTypedWhereMemoryDoesNotSuffice) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(4000).points);
  const Solver solver = Solver::laplacian(laplacian, {.threads = 1});
  const Eigen::MatrixXd b = Eigen::MatrixXd::Zero(4000, 20000);  // 640 MB, and x would be as much
  std::string said = "solved";
  try {
    const ResourceLimit tight(RLIMIT_AS, addressBytes());
    solver.solve(b);
  } catch (const SolverFailure& error) {
    said = error.what();
  }
  EXPECT_EQ(said.find("Solver::solve: memory does not suffice to solve for 20000 right sides"), 0) << said;
}

TEST(Multigrid, NeedsAtMost60IterationsOnScans) {
  const Points scans[] = {shapes::depthCamera({}).points, shapes::lidar({.rings = 32, .noise = 0.01}).points,
                          shapes::withNoise(shapes::torus(30000), 0.02).points,
                          shapes::torus(30000, shapes::Sampling::scanLines(10)).points,
                          shapes::sphere(30000, shapes::Sampling::densityStep(100)).points};
  for (const Points& points : scans) {
    const Laplacian laplacian = pointCloudLaplacian(points, {.keep_cover = false});
    const SolverOptions options = {.method = SolverMethod::multigrid, .tolerance = 1e-10, .max_iterations = 60};
    SolveReport report;
    Solver::laplacian(laplacian, options).solve(VectorXd::LinSpaced(points.rows(), -1, 1), &report);
    EXPECT_LE(report.iterations, 60);
    EXPECT_LE(report.residual, 1e-9);
  }
}

}  // namespace
}  // namespace tufted::solver_scaling_test
