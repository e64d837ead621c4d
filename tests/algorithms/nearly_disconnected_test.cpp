// Parts that are nearly disconnected: what flows from one to the other is right, and reports name them.
#include "algorithms/nearly_disconnected.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/joined_grids.h"
#include "support/overshoot.h"
#include "tufted/tufted.h"

namespace tufted::nearly_disconnected_test {
namespace {

using support::joinedGrids;

constexpr int side = 30, size = side * side;
constexpr std::array methods = {SolverMethod::cholesky, SolverMethod::multigrid};
/// Components end at 1e-14 of the smaller diagonal, which is 2 at the corners.
constexpr std::array weights = {1.0, 1e-3, 1e-5, 1e-6, 1e-7, 1e-9, 1e-12, 1e-13, 3e-14};

VectorXd randomValues(Eigen::Index count, std::uint64_t seed) {
  shapes::Random random(seed);
  VectorXd values(count);
  for (double& value : values) value = random.uniform(-1, 2);
  return values;
}

/// What flows over the joint before grid `k`, against all that springs up in the grids before it: they are equal.
void expectFlux(const std::string& name, double weight, const VectorXd& b, const VectorXd& x, int k) {
  const double flux = weight * (x[k * size - 1] - x[k * size]), sum = b.head(k * size).sum();
  EXPECT_NEAR(flux, sum, 1e-10 * b.cwiseAbs().sum()) << name << ", " << weight;
}

void expectReport(const std::string& name, double weight, const SolveReport& report) {
  EXPECT_LE(report.backward_error, 1e-13) << name << ", " << weight;
  if (weight <= 1e-9) {
    EXPECT_GT(report.residual, 1e-8) << name << ", " << weight;
  }
  EXPECT_EQ(report.weak_joint.has_value(), report.residual > 1e-8) << name << ", " << weight;
  if (!report.weak_joint) return;
  EXPECT_EQ(report.weak_joint->first, 0) << name;
  EXPECT_EQ(report.weak_joint->second, size) << name;
  EXPECT_EQ(report.weak_joint->first_points, size) << name;
  EXPECT_EQ(report.weak_joint->second_points, size) << name;
  EXPECT_EQ(report.weak_joint->weight, weight) << name;
}

TEST(NearlyDisconnected, WhatFlowsOverAJointIsWhatSpringsUpBehindIt) {
  for (const double weight : weights) {
    const Laplacian laplacian = joinedGrids(side, {weight});
    for (const SolverMethod method : methods) {
      const SolverOptions options = {.method = method};
      const VectorXd f = randomValues(2 * size, 101);
      const VectorXd delta = VectorXd::Unit(2 * size, 0).array() - 1.0 / (2 * size);
      const VectorXd balanced = f.array() - f.mean();
      SolveReport green, unpinned, solved, pinned;
      expectFlux("green", weight, delta, greensFunction(laplacian, {0}, options, &green), 1);
      expectFlux("poisson", weight, balanced, poisson(laplacian, f, options, &unpinned), 1);
      expectFlux("solve", weight, balanced, Solver::laplacian(laplacian, options).solve(f, &solved), 1);
      VectorXd beyond = f;  // the pin at 0 takes what is left
      beyond[0] -= f.sum();
      expectFlux("pinned", weight, beyond, poisson(laplacian, f, {{0}, Eigen::MatrixXd::Ones(1, 1)}, options, &pinned),
                 1);
      expectReport("green", weight, green);
      expectReport("poisson", weight, unpinned);
      expectReport("solve", weight, solved);
      expectReport("pinned", weight, pinned);
    }
  }
}

TEST(NearlyDisconnected, ADipoleLeavesNothingToFlow) {
  // Nothing flows over the joint, so the far part has the value of the near end; a factor of the whole is 1e-3 off.
  for (const double weight : {1e-9, 1e-12, 1e-13}) {
    const Laplacian laplacian = joinedGrids(side, {weight});
    const VectorXd b = VectorXd::Unit(2 * size, 0) - VectorXd::Unit(2 * size, 200);
    const VectorXd x = Solver::laplacian(laplacian).solve(b);
    EXPECT_LE((x.tail(size).array() - x[size - 1]).abs().maxCoeff(), 1e-10) << weight;
  }
}

TEST(NearlyDisconnected, HarmonicFunctionsStayWithinTheirPins) {
  for (const double weight : weights) {
    const Laplacian laplacian = joinedGrids(side, {weight});
    for (const SolverMethod method : methods) {
      const Pins near{{0, size - 1, 300}, Eigen::VectorXd{{-1, 2, 0.5}}};
      SolveReport report;
      const VectorXd u = harmonic(laplacian, near, {.method = method}, &report);
      EXPECT_LE(support::overshoot(laplacian, u, near), 1e-12) << weight;
      EXPECT_LE((u.tail(size).array() - 2).abs().maxCoeff(), 1e-12) << weight;  // joined to that pin alone
      EXPECT_LE(report.backward_error, 1e-13) << weight;
      const Pins both{{0, 300, 2 * size - 1}, Eigen::VectorXd{{-1, 0.5, 2}}};
      EXPECT_LE(support::overshoot(laplacian, harmonic(laplacian, both, {.method = method}), both), 1e-12) << weight;
    }
  }
}

TEST(NearlyDisconnected, TheWeakestJointOfSeveralIsNamedAndAllOfThemCarryTheirFlux) {
  const std::vector<double> joints = {1e-8, 1e-12, 1e-7};
  const Laplacian laplacian = joinedGrids(side, joints);
  const VectorXd f = randomValues(4 * size, 102), b = f.array() - f.mean();
  SolveReport report;
  const VectorXd x = poisson(laplacian, f, {}, &report);
  for (int k = 1; k <= 3; ++k) expectFlux("poisson", joints[k - 1], b, x, k);
  ASSERT_TRUE(report.weak_joint.has_value());
  EXPECT_EQ(report.weak_joint->first, 0);
  EXPECT_EQ(report.weak_joint->first_points, 2 * size);
  EXPECT_EQ(report.weak_joint->second, 2 * size);
  EXPECT_EQ(report.weak_joint->second_points, 2 * size);
  EXPECT_EQ(report.weak_joint->weight, 1e-12);
  EXPECT_FALSE(weakestJoint(joinedGrids(side, {1e-5}).L).has_value());
  EXPECT_FALSE(weakestJoint(pointCloudLaplacian(shapes::twoSpheres(1)).L).has_value());  // apart, not badly joined
}

TEST(NearlyDisconnected, PartsWhoseJointsAreNoWeakerThanTheirLengthAreSolvedTogether) {
  // Rectangles that get wider and wider: across them weights grow, along them they fall, to 1e-7 of the diagonal.
  constexpr int columns = 31;
  Points points(2 * columns, 3);
  Triangles triangles(2 * (columns - 1), 3);
  for (int i = 0; i < columns; ++i) {
    points.row(2 * i) << std::pow(1.5, i), 0, 0;
    points.row(2 * i + 1) << std::pow(1.5, i), 1, 0;
  }
  for (int i = 0; i + 1 < columns; ++i) {
    triangles.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 1;
    triangles.row(2 * i + 1) << 2 * i + 1, 2 * i + 2, 2 * i + 3;
  }
  const Laplacian laplacian = meshLaplacian(points, triangles, {.mollify = 0});
  ASSERT_GT(findParts(laplacian).count, findComponents(laplacian).count);
  VectorXd along = VectorXd::Zero(2 * columns);  // L of x is 0 but at the ends
  along.head(2).setConstant(-0.5), along.tail(2).setConstant(0.5);
  const VectorXd truth = points.col(0).array() - laplacian.M.dot(points.col(0)) / laplacian.M.sum();
  for (const SolverMethod method : methods) {
    SolveReport report;
    const VectorXd x = Solver::laplacian(laplacian, {.method = method}).solve(along, &report);
    // Lengths are rounded, and so are the weights that come from them; what flows is not.
    EXPECT_LE((x - truth).cwiseAbs().maxCoeff(), 1e-6 * points.col(0).maxCoeff());
    for (int end = 2; end < 2 * columns; end += 2) {
      double flux = 0;
      for (int i = 0; i < end; ++i)
        for (SparseMatrix::InnerIterator entry(laplacian.L, i); entry; ++entry)
          if (entry.row() >= end) flux -= entry.value() * (x[i] - x[entry.row()]);
      EXPECT_NEAR(flux, -1, 1e-7) << end;
    }
    EXPECT_LE(report.backward_error, 1e-13);
  }
  const Pins ends{{0, 1, 2 * columns - 2}, points.col(0)({0, 1, 2 * columns - 2})};
  EXPECT_LE((harmonic(laplacian, ends) - points.col(0)).cwiseAbs().maxCoeff(), 1e-6 * points.col(0).maxCoeff());
  EXPECT_TRUE(DistanceSolver(laplacian).query({0}).allFinite());
}

TEST(NearlyDisconnected, APartOfAPositiveDefiniteMatrixIsNamedWithWhatHoldsIt) {
  SparseMatrix A = joinedGrids(side, {1e-9}).L;
  A.coeffRef(5, 5) += 1;
  SolveReport report;
  Solver::positiveDefinite(A).solve(VectorXd::Ones(2 * size), &report);
  EXPECT_GT(report.residual, 1e-8);
  EXPECT_LE(report.backward_error, 1e-13);
  ASSERT_TRUE(report.weak_joint.has_value());
  EXPECT_EQ(report.weak_joint->first_points, size);
  EXPECT_EQ(report.weak_joint->second, size);
  EXPECT_EQ(report.weak_joint->weight, 1e-9);
  // A mass everywhere holds every part by itself.
  for (int i = 0; i < 2 * size; ++i) A.coeffRef(i, i) += 1;
  Solver::positiveDefinite(A).solve(VectorXd::Ones(2 * size), &report);
  EXPECT_LE(report.residual, 1e-12);
  EXPECT_FALSE(report.weak_joint.has_value());
}

TEST(NearlyDisconnected, IsSolvedOnAnyNumberOfThreadsWithTheSameBits) {
  const Laplacian laplacian = joinedGrids(side, {1e-12});
  const Eigen::MatrixXd b = randomValues(Eigen::Index{2} * size * 20, 103).reshaped(2 * size, 20);
  const Eigen::MatrixXd one = Solver::laplacian(laplacian, {.threads = 1}).solve(b);
  EXPECT_TRUE(one == Solver::laplacian(laplacian, {.threads = 3}).solve(b));
}

TEST(Solver, FailsTypedWhereTheBackwardErrorStaysLarge) {
  Laplacian laplacian = joinedGrids(side, {1.0});
  laplacian.L.diagonal() *= 10;  // rows do not sum to 0
  try {
    Solver::laplacian(laplacian).solve(randomValues(2 * size, 104));
    FAIL() << "solved";
  } catch (const SolverFailure& error) {
    const std::string said = error.what();
    EXPECT_EQ(said.find("Solver::solve: the backward error |b - A x| / (|A| |x| + |b|) is "), 0u) << said;
    EXPECT_NE(said.find("must be 1e-13; validate() names what is wrong"), std::string::npos) << said;
  }
}

TEST(Solver, EndsWithASmallBackwardErrorWhereSolutionsCrossZero) {
  // Next to where x is 0 its last digits are those of its largest value: a single solve leaves 1e-11.
  const Points points = shapes::sphere(100000, shapes::Sampling::uniform, 105).points;
  const Laplacian laplacian = pointCloudLaplacian(points, {.keep_cover = false});
  Eigen::MatrixXd b(points.rows(), 8);
  for (int c = 0; c < 8; ++c) b.col(c) = laplacian.M.array() * (points.col(0).array() * (c + 1)).sin();
  SolveReport report;
  Solver::laplacian(laplacian).solve(b, &report);
  EXPECT_LE(report.backward_error, 1e-13);
  EXPECT_FALSE(report.weak_joint.has_value());
}

}  // namespace
}  // namespace tufted::nearly_disconnected_test
