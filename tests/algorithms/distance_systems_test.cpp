// Distances by heat: how their systems are solved, what that takes, and how it fails.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/tufted.h"

namespace tufted::distance_systems_test {
namespace {

using support::meanError;

TEST(Distance, GoesOnWhereNotEvenAWindowHasAFactor) {
  // By conjugate gradients heat is seen over 9 decades, some ten edges.
  const Laplacian laplacian = pointCloudLaplacian(shapes::square(20000).points);
  const VectorXd distance = DistanceSolver(laplacian, {.method = DistanceMethod::heat}).query({0});
  DistanceReport report;
  const VectorXd again =
      DistanceSolver(laplacian, {.method = DistanceMethod::heat, .solver = {.memory_limit = 1}}).query({0}, &report);
  EXPECT_GE(report.rounds, 5);
  EXPECT_LE(report.rounds, 30);
  EXPECT_GT(report.iterations, 0);
  EXPECT_LE(meanError(again, distance), 3e-3);  // the method itself errs by 9e-3
}

TEST(Distance, ByMultigridIsAsGoodAsItsTolerance) {
  // Heat is looked at far below its largest value: a loose tolerance must not reach it.
  const Laplacian laplacian = pointCloudLaplacian(shapes::square(4000).points);
  const VectorXd distance = DistanceSolver(laplacian, {.method = DistanceMethod::heat}).query({0});
  for (const double tolerance : {0.1, 1e-2, 1e-4}) {
    const SolverOptions options = {.method = SolverMethod::multigrid, .tolerance = tolerance};
    const VectorXd loose = DistanceSolver(laplacian, {.method = DistanceMethod::heat, .solver = options}).query({0});
    EXPECT_LE(meanError(loose, distance), 3e-3 + tolerance) << tolerance;
  }
}

TEST(Distance, KeepsAllItsFactorsWithinTheLimit) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::disk(2000).points);
  const std::size_t one = Solver::laplacian(laplacian).report().factor_bytes;
  const auto iterationsWithin = [&](std::size_t limit) {
    DistanceReport report;
    DistanceSolver(laplacian, {.method = DistanceMethod::heat, .solver = {.memory_limit = limit}}).query({0}, &report);
    return report.iterations;
  };
  EXPECT_EQ(iterationsWithin(4 * one), 0);
  EXPECT_GT(iterationsWithin(3 * one / 2), 0);  // one fits, three do not
}

TEST(Distance, ReportsWhatItsFactorisationsTake) {
  const Points disk = shapes::disk(2000).points;  // that ends: three systems
  const Laplacian laplacian = pointCloudLaplacian(disk);
  const SolverReport one = Solver::laplacian(laplacian).report();
  const SolverReport all = DistanceSolver(laplacian, {.method = DistanceMethod::heat}).report();
  EXPECT_EQ(all.method, one.method);
  EXPECT_FALSE(all.iterative);
  EXPECT_EQ(all.components, 1);
  EXPECT_GT(all.seconds, 0);
  EXPECT_GT(all.unknowns, 2 * one.unknowns + 1);
  EXPECT_NEAR(static_cast<double>(all.bytes), 3.0 * static_cast<double>(one.bytes), 0.5 * one.bytes);
  EXPECT_EQ(all.bytes, all.factor_bytes);
  const SolverReport closed =
      DistanceSolver(laplacian, {.method = DistanceMethod::heat, .open_boundary = false}).report();
  EXPECT_EQ(closed.unknowns, 2000 + 1999);
  const SolverReport by_multigrid =
      DistanceSolver(laplacian, {.method = DistanceMethod::heat, .solver = {.method = SolverMethod::multigrid}})
          .report();
  EXPECT_TRUE(by_multigrid.iterative);
  EXPECT_EQ(by_multigrid.method.find(" and "), std::string::npos) << by_multigrid.method;
}

}  // namespace
}  // namespace tufted::distance_systems_test
