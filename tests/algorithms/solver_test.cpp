// Linear systems: that what comes back solves them, what happens to constants, and what callers may ask for.
#include "tufted/solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/tufted.h"

namespace tufted::solver_test {
namespace {

using Eigen::MatrixXd;

constexpr std::array methods = {SolverMethod::cholesky, SolverMethod::multigrid};

std::vector<std::pair<std::string, Points>> differentClouds() {
  return {{"two spheres", shapes::twoSpheres(0.1)},
          {"spheres of unlike size", shapes::twoSpheres(1e-7)},
          {"depth camera", shapes::depthCamera({.width = 160, .height = 120}).points},
          {"noisy torus", shapes::withNoise(shapes::torus(4000), 0.01).points},
          {"disk", shapes::disk(2000).points}};
}

SparseMatrix heatMatrix(const Laplacian& laplacian) {
  SparseMatrix A = laplacian.report.mean_squared_edge * laplacian.L;
  for (Eigen::Index i = 0; i < A.cols(); ++i)
    if (laplacian.M[i] > 0) A.coeffRef(i, i) += laplacian.M[i];
  return A;
}

/// Some values, the same on every machine.
MatrixXd someValues(Eigen::Index rows, Eigen::Index columns) {
  return MatrixXd::NullaryExpr(rows, columns, [](Eigen::Index i, Eigen::Index c) {
    return std::sin(1.7 * static_cast<double>(i) + 0.9 * static_cast<double>(c * c));
  });
}

TEST(Solver, SolvesPositiveDefiniteSystems) {
  for (const auto& [name, points] : differentClouds()) {
    const Laplacian laplacian = pointCloudLaplacian(points);
    const SparseMatrix A = heatMatrix(laplacian);
    const MatrixXd b = A * someValues(points.rows(), 3);  // 0 in the rows that take no part
    for (const SolverMethod method : methods) {
      SolveReport report;
      const MatrixXd x = Solver::positiveDefinite(A, {.method = method}).solve(b, &report);
      for (int c = 0; c < 3; ++c) EXPECT_LE((b - A * x).col(c).norm(), 1e-11 * b.col(c).norm()) << name;
      EXPECT_LE(report.residual, 1e-11) << name;
      EXPECT_EQ(report.iterations > 0, method == SolverMethod::multigrid);
      for (Eigen::Index i = 0; i < points.rows(); ++i) EXPECT_TRUE(A.coeff(i, i) != 0 || x.row(i).isZero(0)) << i;
    }
  }
}

TEST(Solver, SolvesWithALaplacianUpToAConstantPerComponent) {
  for (const auto& [name, points] : differentClouds()) {
    const Laplacian laplacian = pointCloudLaplacian(points);
    VectorXd f = someValues(points.rows(), 1);  // with a mean, and not 0 where points are not active
    for (const SolverMethod method : methods) {
      const Solver solver = Solver::laplacian(laplacian, {.method = method});
      EXPECT_EQ(solver.report().components, laplacian.report.components) << name;
      SolveReport report;
      const VectorXd x = solver.solve(f, &report);
      EXPECT_LE(report.residual, 1e-9) << name;
      // What is missing from L x = f is M times one number per component, and sum(M x) is 0 on each.
      const VectorXd missing = f - laplacian.L * x;
      double sum_of_x = 0, scale = 0;
      for (Eigen::Index i = 0; i < points.rows(); ++i) {
        if (laplacian.status[i] != PointStatus::active) {
          EXPECT_EQ(x[i], 0) << name << ", " << i;
          continue;
        }
        sum_of_x += laplacian.M[i] * x[i];
        scale += laplacian.M[i] * std::abs(x[i]);
        for (SparseMatrix::InnerIterator entry(laplacian.L, i); entry; ++entry) {
          const auto j = entry.row();
          EXPECT_NEAR(missing[i] * laplacian.M[j], missing[j] * laplacian.M[i],
                      1e-8 * (laplacian.M[i] + laplacian.M[j]))
              << name << ", " << i << ", " << j;
        }
      }
      EXPECT_LE(std::abs(sum_of_x), 1e-12 * scale) << name;
    }
  }
}

TEST(Solver, InvertsOnWhatAConstantDoesNotTouch) {
  // Poisson on the unit sphere: z is an eigenfunction of eigenvalue 2, so L z / 2 is nearly M z.
  const Points points = shapes::sphere(16000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Solver solver = Solver::laplacian(laplacian);
  const VectorXd z = solver.solve(laplacian.M.cwiseProduct(points.col(2)));
  EXPECT_LE((z - points.col(2) / 2).cwiseAbs().maxCoeff(), 0.02);
  // Exact: L of any function solves back to it, but for its mean.
  const VectorXd u = someValues(16000, 1), back = solver.solve(laplacian.L * u);
  const double mean = laplacian.M.dot(u) / laplacian.M.sum();
  EXPECT_LE((back.array() - (u.array() - mean)).abs().maxCoeff(), 1e-10);
}

TEST(Solver, FindsNothingWhereTheMeanIsAllThereIs) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(4000).points);
  for (const SolverMethod method : methods) {
    SolveReport report;
    const VectorXd x = Solver::laplacian(laplacian, {.method = method}).solve(laplacian.M, &report);
    EXPECT_LE(x.cwiseAbs().maxCoeff(), 1e-14 * laplacian.M.sum());
    EXPECT_LE(report.residual, 1e-13);
    EXPECT_LE(report.backward_error, 1e-12);  // of what rounding leaves of M less its mean
  }
}

TEST(Solver, IsSymmetricWithALaplacian) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::twoSpheres(0.5));
  const Solver solver = Solver::laplacian(laplacian);
  const MatrixXd b = someValues(2000, 2), x = solver.solve(b);
  EXPECT_NEAR(b.col(0).dot(x.col(1)), b.col(1).dot(x.col(0)), 1e-10 * b.col(0).norm() * x.col(1).norm());
}

TEST(Solver, OnAnyNumberOfThreadsGivesTheSameBits) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(4000).points);
  const MatrixXd b = someValues(4000, 70);
  for (const SolverMethod method : methods) {
    const MatrixXd one = Solver::laplacian(laplacian, {.method = method, .threads = 1}).solve(b);
    const MatrixXd three = Solver::laplacian(laplacian, {.method = method, .threads = 3}).solve(b);
    EXPECT_TRUE(support::sameBits(one.data(), three.data(), one.size()));
  }
}

TEST(Solver, SolvesManyRightSidesAsOneByOne) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(4000).points);
  const SparseMatrix A = heatMatrix(laplacian);
  const Solver solver = Solver::positiveDefinite(A);
  const MatrixXd b = someValues(4000, 37), x = solver.solve(b);
  for (int c = 0; c < 37; ++c) EXPECT_LE((solver.solve(b.col(c)) - x.col(c)).norm(), 1e-13 * x.col(c).norm());
  EXPECT_EQ(solver.solve(MatrixXd(4000, 0)).cols(), 0);
}

TEST(Solver, TakesMultigridWhereAFactorDoesNotFit) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(4000).points);
  const Solver large = Solver::laplacian(laplacian);
  EXPECT_TRUE(large.report().method.starts_with("Cholesky")) << large.report().method;
  EXPECT_GE(large.report().nonzeros, 10 * 4000);
  EXPECT_GE(large.report().factor_bytes, 8 * static_cast<std::size_t>(large.report().nonzeros));
  const std::size_t limit = large.report().factor_bytes / 2;  // more than another ordering saves
  const Solver small = Solver::laplacian(laplacian, {.memory_limit = limit});
  EXPECT_TRUE(small.report().method.starts_with("multigrid")) << small.report().method;
  EXPECT_LT(small.report().bytes, limit);
  EXPECT_EQ(small.report().unknowns, 3999);
  const VectorXd b = someValues(4000, 1);
  EXPECT_LE((large.solve(b) - small.solve(b)).norm(), 1e-9 * large.solve(b).norm());
}

#ifdef TUFTED_WITH_GPL
TEST(Solver, TakesNestedDissectionWhereItSavesWhatIsMissing) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(20000).points, {.keep_cover = false});
  const SolverReport first = Solver::laplacian(laplacian).report();
  EXPECT_EQ(first.method, "Cholesky (CHOLMOD, AMD)");
  const std::size_t limit = first.factor_bytes - 1;
  const Solver dissected = Solver::laplacian(laplacian, {.memory_limit = limit});
  EXPECT_EQ(dissected.report().method, "Cholesky (CHOLMOD, METIS)");
  EXPECT_LE(dissected.report().factor_bytes, limit);
  EXPECT_LT(dissected.report().nonzeros, first.nonzeros);
  SolveReport report;
  dissected.solve(laplacian.L * someValues(20000, 1), &report);
  EXPECT_LE(report.residual, 1e-9);
}
#endif

TEST(Solver, KeepsUnknownsOfAnyScaleApartByCholesky) {
  // Diagonal entries from 1e-200 to 1e200 do not disturb each other.
  SparseMatrix A(5, 5);
  const VectorXd scale{{1e-200, 1, 0, 1e9, 1e200}};
  for (int i = 0; i < 5; ++i)
    if (scale[i] != 0) A.insert(i, i) = scale[i];
  const VectorXd b{{1e-200, 2, NAN, 3e9, 4e200}};
  const VectorXd x = Solver::positiveDefinite(A, {.method = SolverMethod::cholesky}).solve(b);
  EXPECT_LE((x - VectorXd{{1, 2, 0, 3, 4}}).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Solver, TakesCloudsWithoutSurface) {
  const Points line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {NAN, 0, 0}};
  for (const Points& points : {line, Points(0, 3)}) {
    const Solver solver = Solver::laplacian(pointCloudLaplacian(points));
    EXPECT_EQ(solver.report().components, 0);
    EXPECT_TRUE(solver.solve(MatrixXd::Ones(points.rows(), 2)).isZero(0));
  }
}

TEST(Solver, NamesWhatACallerGotWrong) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(500).points);
  const auto refusal = [&](const SolverOptions& options, const MatrixXd& b) {
    try {
      Solver::laplacian(laplacian, options).solve(b);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const VectorXd good = VectorXd::Ones(500);
  VectorXd odd = good;
  odd[77] = INFINITY;
  EXPECT_EQ(refusal({.tolerance = 0}, good), "Solver::laplacian: tolerance = 0, must lie in (0, 1)");
  EXPECT_NE(refusal({.tolerance = NAN}, good), "accepted");
  EXPECT_EQ(refusal({.max_iterations = 0}, good), "Solver::laplacian: max_iterations = 0, must be at least 1");
  EXPECT_EQ(refusal({.threads = -1}, good), "Solver::laplacian: threads = -1, must be >= 0");
  EXPECT_EQ(refusal({}, good.head(499)), "Solver::solve: b has 499 rows, must have 500");
  EXPECT_EQ(refusal({}, odd), "Solver::solve: b has values that are not finite, must have none");
  EXPECT_THROW(Solver::positiveDefinite(SparseMatrix(3, 4)), InvalidInput);
  Laplacian torn = laplacian;
  torn.M.conservativeResize(499);
  EXPECT_THROW(Solver::laplacian(torn), InvalidInput);
}

TEST(Solver, FailsTypedWhenTheMatrixIsNotPositiveDefinite) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(500).points);
  for (const SolverMethod method : methods) {
    for (const double factor : {-1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
      Laplacian wrong = laplacian;
      wrong.L *= factor;
      EXPECT_THROW(Solver::laplacian(wrong, {.method = method}), SolverFailure) << factor;
      EXPECT_THROW(Solver::positiveDefinite(factor * heatMatrix(laplacian), {.method = method}), SolverFailure);
    }
  }
  // One wrong entry, seen by elimination alone.
  SparseMatrix saddle = heatMatrix(laplacian);
  saddle.coeffRef(100, 100) *= 1e-6;
  EXPECT_THROW(Solver::positiveDefinite(saddle, {.method = SolverMethod::cholesky}), SolverFailure);
}

TEST(Solver, FailsTypedWhereTheSolutionOverflows) {
  SparseMatrix A(2, 2);
  A.coeffRef(0, 0) = A.coeffRef(1, 1) = 2e-309;
  A.coeffRef(0, 1) = A.coeffRef(1, 0) = -1e-309;
  const Solver solver = Solver::positiveDefinite(A);
  try {
    solver.solve(MatrixXd::Ones(2, 9));
    FAIL() << "solved";
  } catch (const SolverFailure& error) {
    EXPECT_STREQ(error.what(), "Solver::solve: the solution overflows; scale the right sides down");
  }
}

TEST(Solver, TakesRightSidesThatVanishOnPartsOfASurface) {
  // High eigenvectors are nearly 0 except around a few points.
  for (const auto& [n, seed] : {std::pair(300, 101), std::pair(300, 102), std::pair(500, 108)}) {
    const Laplacian laplacian =
        pointCloudLaplacian(shapes::sphere(n, shapes::Sampling::uniform, seed).points, cloudOptions(Preset::clean));
    const Eigen::MatrixXd vectors = spectrum(laplacian, n - 1).vectors.rightCols(n - 2);
    SolveReport report;
    Solver::laplacian(laplacian).solve(laplacian.M.asDiagonal() * vectors, &report);
    EXPECT_LE(report.backward_error, 1e-13);
  }
}

}  // namespace
}  // namespace tufted::solver_test
