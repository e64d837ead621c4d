// Multigrid on clouds of growing size.
#include <gtest/gtest.h>

#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted {
namespace {

TEST(Multigrid, NeedsAtMost60IterationsFrom10kTo300kPoints) {
  for (const int n : {10000, 30000, 100000, 300000}) {
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

TEST(Multigrid, NeedsAtMost60IterationsOnScans) {
  const Points scans[] = {shapes::depthCamera({}).points, shapes::lidar({.rings = 32, .noise = 0.01}).points,
                          shapes::withNoise(shapes::torus(100000), 0.02).points,
                          shapes::torus(100000, shapes::Sampling::scanLines(10)).points,
                          shapes::sphere(100000, shapes::Sampling::densityStep(100)).points};
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
}  // namespace tufted
