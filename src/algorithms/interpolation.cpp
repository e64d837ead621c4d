#include "tufted/interpolation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "algorithms/pinned_system.h"
#include "base/stage_clock.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// Solves are repeated for what is missing until it is next to nothing: rarely more than twice.
constexpr int most_corrections = 6;
constexpr double negligible = 1e-15;  // of the values' range
/// Masses below this part of the mean count as that much where they are divided by: zero areas would bend nothing.
constexpr double least_mass = 1e-9;

using Residual = std::function<Eigen::RowVectorXd(const Eigen::MatrixXd& u, int point)>;

/// Finds u at the free points from what is missing there, b - A u, and adds until nothing is missing. Far more accurate
/// than one solve, as the residual comes from differences of neighbours.
/// @param A its rows and columns of free points make the system
Eigen::MatrixXd solvePinned(PinnedSystem system, SparseMatrix A, const Residual& missing, const SolverOptions& options,
                            SolveReport& report) {
  A.prune([&](Eigen::Index i, Eigen::Index j, double) { return system.free[i] != 0 && system.free[j] != 0; });
  const Solver solver = Solver::positiveDefinite(A, options);
  Eigen::MatrixXd& u = system.values;
  double last = std::numeric_limits<double>::infinity();
  for (int round = 0; round < most_corrections; ++round) {
    Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(u.rows(), u.cols());
    for (const int i : system.components.points) {
      if (system.free[i] != 0) rest.row(i) = missing(u, i);
    }
    SolveReport solved;
    const Eigen::MatrixXd step = solver.solve(rest, &solved);
    if (!step.allFinite()) break;
    report.iterations = std::max(report.iterations, solved.iterations);
    if (round == 0) report.residual = solved.residual;
    double largest = 0, range = 0;
    for (const int i : system.components.points) {
      if (system.free[i] == 0) continue;
      largest = std::max(largest, step.row(i).cwiseAbs().maxCoeff());
    }
    if (!(largest < last / 2)) break;  // rounding is all that is left
    for (const int i : system.components.points) {
      if (system.free[i] == 0) continue;
      u.row(i) += step.row(i);
      range = std::max(range, u.row(i).cwiseAbs().maxCoeff());
    }
    last = largest;
    if (largest <= negligible * range) break;
  }
  return std::move(system.values);
}

/// Pinned copies keep the mean of their place.
void copyToCoincident(const Laplacian& laplacian, Eigen::MatrixXd& u) {
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    if (laplacian.status[i] == PointStatus::coincident) u.row(i) = u.row(laplacian.representative[i]);
  }
}

Eigen::MatrixXd finish(const Laplacian& laplacian, Eigen::MatrixXd u, const Stopwatch& watch, SolveReport made,
                       SolveReport* report) {
  copyToCoincident(laplacian, u);
  made.seconds = watch.seconds();
  if (report != nullptr) *report = made;
  return u;
}

/// L u = b at free points.
Eigen::MatrixXd solveWithPins(const std::string& function, const Laplacian& laplacian, const Pins& pins,
                              const Eigen::MatrixXd* f, const SolverOptions& options, SolveReport* report) {
  const Stopwatch watch;
  SolveReport made;
  const Residual missing = [&](const Eigen::MatrixXd& u, int i) {
    Eigen::RowVectorXd rest = -rowOfDifferences(laplacian.L, u, i);
    if (f != nullptr) rest += laplacian.M[i] * f->row(i);
    return rest;
  };
  Eigen::MatrixXd u = solvePinned(pinnedSystem(function, laplacian, pins), laplacian.L, missing, options, made);
  return finish(laplacian, std::move(u), watch, made, report);
}

void checkRight(const std::string& function, const Laplacian& laplacian, const Eigen::MatrixXd& f) {
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  if (f.rows() != n) {
    throw InvalidInput(function + ": f has " + std::to_string(f.rows()) + " rows, must have " + std::to_string(n) +
                       ", one per point of the Laplacian");
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (laplacian.status[i] == PointStatus::active && !f.row(i).allFinite()) {
      throw InvalidInput(function + ": f of point " + std::to_string(i) + " is not finite, must be");
    }
  }
}

/// L u = b by components, with mean 0.
Eigen::MatrixXd solveBalanced(const Laplacian& laplacian, const Eigen::MatrixXd& b, const SolverOptions& options,
                              SolveReport* report) {
  const Stopwatch watch;
  SolveReport made;
  Eigen::MatrixXd u = Solver::laplacian(laplacian, options).solve(b, &made);
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    if (laplacian.status[i] != PointStatus::active) u.row(i).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return finish(laplacian, std::move(u), watch, made, report);
}

}  // namespace

Eigen::MatrixXd harmonic(const Laplacian& laplacian, const Pins& pins, const SolverOptions& options,
                         SolveReport* report) {
  return solveWithPins("harmonic", laplacian, pins, nullptr, options, report);
}

Eigen::MatrixXd biharmonic(const Laplacian& laplacian, const Pins& pins, const SolverOptions& options,
                           SolveReport* report) {
  const Stopwatch watch;
  PinnedSystem system = pinnedSystem("biharmonic", laplacian, pins);
  const auto points = static_cast<double>(std::max<std::size_t>(system.components.points.size(), 1));
  const double mean = laplacian.M.sum() / points;
  VectorXd inverse = VectorXd::Zero(laplacian.M.size());  // of M over its mean
  for (const int i : system.components.points) {
    inverse[i] = mean > 0 ? 1 / std::max(laplacian.M[i] / mean, least_mass) : 1;
  }
  const SparseMatrix weighted = inverse.asDiagonal() * laplacian.L;
  const SparseMatrix bending = SparseMatrix(laplacian.L * weighted);
  const SparseMatrix& L = laplacian.L;
  const Residual missing = [&](const Eigen::MatrixXd& u, int i) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(u.cols());
    for (SparseMatrix::InnerIterator entry(L, i); entry; ++entry) {
      const int j = static_cast<int>(entry.row());
      sum -= entry.value() * inverse[j] * rowOfDifferences(L, u, j);
    }
    return sum;
  };
  SolveReport made;
  Eigen::MatrixXd u = solvePinned(std::move(system), bending, missing, options, made);
  return finish(laplacian, std::move(u), watch, made, report);
}

Eigen::MatrixXd poisson(const Laplacian& laplacian, const Eigen::MatrixXd& f, const SolverOptions& options,
                        SolveReport* report) {
  checkRight("poisson", laplacian, f);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(f.rows(), f.cols());
  for (Eigen::Index i = 0; i < f.rows(); ++i) {
    if (laplacian.status[i] == PointStatus::active) b.row(i) = laplacian.M[i] * f.row(i);
  }
  return solveBalanced(laplacian, b, options, report);
}

Eigen::MatrixXd poisson(const Laplacian& laplacian, const Eigen::MatrixXd& f, const Pins& pins,
                        const SolverOptions& options, SolveReport* report) {
  checkRight("poisson", laplacian, f);
  if (f.cols() != pins.values.cols()) {
    throw InvalidInput("poisson: f has " + std::to_string(f.cols()) + " columns, must have " +
                       std::to_string(pins.values.cols()) + ", as pins.values");
  }
  return solveWithPins("poisson", laplacian, pins, &f, options, report);
}

Eigen::MatrixXd greensFunction(const Laplacian& laplacian, const std::vector<int>& points, const SolverOptions& options,
                               SolveReport* report) {
  const std::string function = "greensFunction";
  const int n = static_cast<int>(laplacian.status.size());
  if (points.empty()) throw InvalidInput(function + ": points is empty, must name at least one");
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k] < 0 || points[k] >= n) {
      throw InvalidInput(function + ": point " + std::to_string(points[k]) + ", must lie in [0, " + std::to_string(n) +
                         ")");
    }
    const int i = laplacian.representative[points[k]];
    if (laplacian.status[i] != PointStatus::active) {
      throw InvalidInput(function + ": point " + std::to_string(points[k]) + " lies on no component, must be active");
    }
    b(i, static_cast<Eigen::Index>(k)) = 1;
  }
  return solveBalanced(laplacian, b, options, report);
}

}  // namespace tufted
