// What every function that solves says of it.
#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::reports_test {
namespace {

using Eigen::MatrixXd;

template <class Report>
void expectReport(const std::string& name, const Report& report, bool iterates, double most_seconds) {
  EXPECT_EQ(report.iterations > 0, iterates) << name;
  EXPECT_TRUE(report.residual > 0 && report.residual < 1e-9) << name << ": " << report.residual;
  EXPECT_TRUE(report.seconds > 0 && report.seconds < most_seconds) << name << ": " << report.seconds;
}

/// Conjugate gradients end by the residual and say nothing of small rows, factors by the backward error.
template <class Report>
void expectBackwardError(const std::string& name, const Report& report, bool iterates) {
  EXPECT_TRUE(report.backward_error > 0 && report.backward_error <= (iterates ? 1 : 1e-13))
      << name << ": " << report.backward_error;
  EXPECT_FALSE(report.weak_joint.has_value()) << name;
}

void expectReport(const std::string& name, const SolverReport& report, bool iterates, double most_seconds) {
  EXPECT_EQ(report.method.find(iterates ? "multigrid" : "Cholesky"), 0u) << name << ": " << report.method;
  EXPECT_EQ(report.iterative, iterates) << name;
  EXPECT_TRUE(report.unknowns > 900 && report.nonzeros > report.unknowns) << name;
  EXPECT_GE(report.bytes, 8 * static_cast<std::size_t>(report.nonzeros)) << name;
  EXPECT_TRUE(report.seconds > 0 && report.seconds < most_seconds) << name << ": " << report.seconds;
}

TEST(EveryReport, HasMethodIterationsResidualAndSeconds) {
  const Points points = shapes::disk(1000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const MatrixXd f = points.leftCols(2);
  const Pins pins{{0, 1}, MatrixXd::Identity(2, 2)};
  for (const SolverMethod method : {SolverMethod::cholesky, SolverMethod::multigrid}) {
    const bool iterates = method == SolverMethod::multigrid;
    const SolverOptions options = {.method = method};
    const auto expectSolve = [&](const std::string& name, const auto& solve) {
      SolveReport report;
      const auto start = std::chrono::steady_clock::now();
      solve(&report);
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      expectReport(name, report, iterates, took.count());
      expectBackwardError(name, report, iterates);
      EXPECT_EQ(report.method.find(iterates ? "multigrid" : "Cholesky"), 0u) << name << ": " << report.method;
    };
    const Solver solver = Solver::laplacian(laplacian, options);
    expectReport("Solver", solver.report(), iterates, 10);
    expectSolve("solve", [&](SolveReport* report) { solver.solve(f, report); });
    expectSolve("harmonic", [&](SolveReport* report) { harmonic(laplacian, pins, options, report); });
    expectSolve("poisson", [&](SolveReport* report) { poisson(laplacian, f, options, report); });
    expectSolve("pinned poisson", [&](SolveReport* report) { poisson(laplacian, f, pins, options, report); });
    expectSolve("green", [&](SolveReport* report) { greensFunction(laplacian, {0, 1}, options, report); });
    if (!iterates)
      expectSolve("biharmonic", [&](SolveReport* report) { biharmonic(laplacian, pins, options, report); });

    const DistanceSolver distance(laplacian, {.method = DistanceMethod::heat, .solver = options});
    expectReport("DistanceSolver", distance.report(), iterates, 10);
    DistanceReport query;
    distance.query({0}, &query);
    expectReport("query", query, iterates, 10);
    expectBackwardError("query", query, iterates);
    EXPECT_EQ(query.rounds, iterates ? query.rounds : 1);

    const Spectrum found = spectrum(laplacian, 10, {.method = method});
    expectReport("spectrum", found.report, true, 60);
    expectReport("spectrum's solver", found.report.solver, iterates, found.report.seconds);
    EXPECT_TRUE(found.report.orthogonality > 0 && found.report.orthogonality < 1e-10);
  }
}

}  // namespace
}  // namespace tufted::reports_test
