#include "tufted/interpolation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "algorithms/connected.h"
#include "algorithms/greater.h"
#include "algorithms/linear_system.h"
#include "algorithms/pinned_system.h"
#include "base/stage_clock.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// Solves are repeated for what is missing until it is next to nothing: rarely more than twice.
constexpr int most_corrections = 6;
constexpr double negligible = 1e-15;  // of the values' range
/// To which conjugate gradients solve at least, so that corrections become small fast.
constexpr double correction_tolerance = 1e-10;
/// A last correction above this part of the range means that the digits are wrong.
constexpr double stalled = 1e-3;
/// Masses below this part of the mean count as that much where they are divided by: zero areas would bend nothing.
constexpr double least_mass = 1e-9;

/// The row of b - A u; u without the mean of the component's pins, so that its digits are those of their differences.
using Missing = std::function<Eigen::RowVectorXd(const Eigen::MatrixXd& u, int point)>;

/// A pinned system that is solved again for what is missing until nothing is. Far more accurate than one solve, as what
/// is missing comes from differences of neighbours.
class Refinement {
 public:
  Refinement(const SystemNames& names, const PinnedSystem& pinned, Missing missing, const SolverOptions& options)
      : names_(names), pinned_(pinned), missing_(std::move(missing)), options_(options), u_(pinned.values) {
    options_.tolerance = std::min(options.tolerance, correction_tolerance);
    for (const int i : pinned_.components.points) {
      const auto mean = pinned_.means.row(pinned_.components.of[i]);
      if (pinned_.pinned[i] != 0) u_.row(i) -= mean;
      if (pinned_.free[i] != 0) u_.row(i).setZero();
    }
  }

  /// @param A its rows and columns of free points make the system
  /// @param report gets all but the seconds, if not null
  Eigen::MatrixXd run(SparseMatrix A, SolveReport* report) {
    A.prune([&](Eigen::Index i, Eigen::Index j, double) { return pinned_.free[i] != 0 && pinned_.free[j] != 0; });
    const LinearSystem system = LinearSystem::positiveDefinite(names_, A, options_);
    open_ = last_ = Eigen::MatrixXd::Ones(pinned_.means.rows(), pinned_.means.cols());
    last_ *= std::numeric_limits<double>::infinity();
    Eigen::RowVectorXd first;
    for (int round = 0; round < most_corrections; ++round) {
      Eigen::MatrixXd rest = missing(open_);
      if (round == 0) first = norms(rest);
      if (rest.isZero(0)) break;
      const Eigen::MatrixXd scale = pinned_.components.normalise(rest);
      SolveReport solved;
      Eigen::MatrixXd step = system.solve(names_.function, rest, &solved, options_.progress);
      pinned_.components.multiply(step, scale);
      add(step, round + 1 == most_corrections);
      if (report != nullptr) report->iterations += solved.iterations;
    }
    if (report != nullptr) {
      report->method = system.report().method;
      const Eigen::RowVectorXd left = norms(missing(Eigen::MatrixXd::Ones(open_.rows(), open_.cols())));
      for (Eigen::Index c = 0; c < left.size(); ++c)
        if (first[c] > 0) report->residual = greater(report->residual, left[c] / first[c]);
    }
    Eigen::MatrixXd result = pinned_.values;
    for (const int i : pinned_.components.points)
      if (pinned_.free[i] != 0) result.row(i) = pinned_.means.row(pinned_.components.of[i]) + u_.row(i);
    return result;
  }

 private:
  static Eigen::RowVectorXd norms(const Eigen::MatrixXd& values) {
    Eigen::RowVectorXd result(values.cols());
    for (Eigen::Index c = 0; c < values.cols(); ++c) result[c] = values.col(c).stableNorm();
    return result;
  }

  /// At the free points, of components and columns where `wanted` is 1.
  Eigen::MatrixXd missing(const Eigen::MatrixXd& wanted) const {
    Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(u_.rows(), u_.cols());
    for (const int i : pinned_.components.points)
      if (pinned_.free[i] != 0) rest.row(i) = missing_(u_, i).cwiseProduct(wanted.row(pinned_.components.of[i]));
    if (!rest.allFinite()) fail("sums of values overflow; scale them down");
    return rest;
  }

  /// Adds a correction, where it is less than half of the last one: beyond that rounding is all that is left.
  /// @param is_last there will be no other
  void add(const Eigen::MatrixXd& step, bool is_last) {
    if (!step.allFinite()) fail("the solution overflows; scale the values down");
    Eigen::MatrixXd largest = Eigen::MatrixXd::Zero(open_.rows(), open_.cols()), range = largest;
    const auto raise = [&](Eigen::MatrixXd& top, const Eigen::MatrixXd& values, int i) {
      auto row = top.row(pinned_.components.of[i]);
      row = row.cwiseMax(values.row(i).cwiseAbs());
    };
    for (const int i : pinned_.components.points)
      if (pinned_.free[i] != 0) raise(largest, step, i);
    open_ = (largest.array() < last_.array() / 2).select(open_, 0);
    for (const int i : pinned_.components.points) {
      if (pinned_.free[i] != 0) u_.row(i) += step.row(i).cwiseProduct(open_.row(pinned_.components.of[i]));
      if (pinned_.free[i] + pinned_.pinned[i] != 0) raise(range, u_, i);
    }
    const auto wrong = largest.array() > stalled * range.array();
    if (is_last ? wrong.any() : (wrong && open_.array() == 0).any())
      fail(
          "corrections do not become small, so digits are wrong; the matrix is too close to singular; set method to "
          "SolverMethod::cholesky, or pin more points");
    open_ = (largest.array() > negligible * range.array()).select(open_, 0);
    last_ = largest;
  }

  [[noreturn]] void fail(const char* what) const { throw SolverFailure(names_.function + ": " + what); }

  const SystemNames& names_;
  const PinnedSystem& pinned_;
  Missing missing_;
  SolverOptions options_;
  Eigen::MatrixXd u_;     ///< N x c, without the means
  Eigen::MatrixXd open_;  ///< components x c; 1 where corrections go on
  Eigen::MatrixXd last_;  ///< the same; the largest of the last correction
};

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
  const SystemNames names = {.function = function, .matrix = "L"};
  const Missing missing = [&](const Eigen::MatrixXd& u, int i) {
    Eigen::RowVectorXd rest = -rowOfDifferences(laplacian.L, u, i);
    if (f != nullptr) rest += laplacian.M[i] * f->row(i);
    return rest;
  };
  const PinnedSystem pinned = pinnedSystem(function, laplacian, pins);
  SolveReport made;
  Eigen::MatrixXd u = Refinement(names, pinned, missing, options).run(laplacian.L, report != nullptr ? &made : nullptr);
  return finish(laplacian, std::move(u), watch, made, report);
}

void checkRows(const std::string& function, const Laplacian& laplacian, const Eigen::MatrixXd& f) {
  const std::size_t n = laplacian.status.size();
  if (static_cast<std::size_t>(f.rows()) == n) return;
  throw InvalidInput(function + " has " + std::to_string(f.rows()) + " rows, must have " + std::to_string(n) +
                     ", one per point of the Laplacian");
}

void checkRight(const std::string& function, const Laplacian& laplacian, const Eigen::MatrixXd& f) {
  checkSizes(function, laplacian);
  checkRows(function + ": f", laplacian, f);
  for (Eigen::Index i = 0; i < f.rows(); ++i) {
    if (laplacian.status[i] == PointStatus::active && !f.row(i).allFinite()) {
      throw InvalidInput(function + ": f of point " + std::to_string(i) + " is not finite, must be");
    }
  }
}

/// L u = b by components, with mean 0.
Eigen::MatrixXd solveBalanced(const std::string& function, const Laplacian& laplacian, const Eigen::MatrixXd& b,
                              const SolverOptions& options, SolveReport* report) {
  const Stopwatch watch;
  SolveReport made;
  Eigen::MatrixXd u = LinearSystem::laplacian({.function = function, .matrix = "L"}, laplacian, options)
                          .solve(function, b, report != nullptr ? &made : nullptr, options.progress);
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
  const SystemNames names = {
      .function = "biharmonic", .matrix = "L M^-1 L", .if_large = "take fewer points", .factor_only = true};
  const PinnedSystem pinned = pinnedSystem(names.function, laplacian, pins);
  const auto points = static_cast<double>(std::max<std::size_t>(pinned.components.points.size(), 1));
  const double mean = laplacian.M.sum() / points;
  VectorXd inverse = VectorXd::Zero(laplacian.M.size());  // of M over its mean
  for (const int i : pinned.components.points) {
    inverse[i] = mean > 0 ? 1 / std::max(laplacian.M[i] / mean, least_mass) : 1;
  }
  const SparseMatrix weighted = inverse.asDiagonal() * laplacian.L;
  const SparseMatrix bending = SparseMatrix(laplacian.L * weighted);
  const SparseMatrix& L = laplacian.L;
  const Missing missing = [&](const Eigen::MatrixXd& u, int i) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(u.cols());
    for (SparseMatrix::InnerIterator entry(L, i); entry; ++entry) {
      const int j = static_cast<int>(entry.row());
      sum -= entry.value() * inverse[j] * rowOfDifferences(L, u, j);
    }
    return sum;
  };
  SolveReport made;
  Eigen::MatrixXd u = Refinement(names, pinned, missing, options).run(bending, report != nullptr ? &made : nullptr);
  return finish(laplacian, std::move(u), watch, made, report);
}

Eigen::MatrixXd componentMeans(const Laplacian& laplacian, const Eigen::MatrixXd& values) {
  checkRows("componentMeans: values", laplacian, values);
  const Components components = findComponents(laplacian);
  const VectorXd weights = components.weights(laplacian.M);
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(values.rows(), values.cols());
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    VectorXd weighted = VectorXd::Zero(values.rows());
    for (const int i : components.points) weighted[i] = weights[i] * values(i, c);
    const VectorXd sums = components.sums(weighted);
    for (const int i : components.points) means(i, c) = sums[components.of[i]];
  }
  copyToCoincident(laplacian, means);
  return means;
}

Eigen::MatrixXd poisson(const Laplacian& laplacian, const Eigen::MatrixXd& f, const SolverOptions& options,
                        SolveReport* report) {
  checkRight("poisson", laplacian, f);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(f.rows(), f.cols());
  for (Eigen::Index i = 0; i < f.rows(); ++i) {
    if (laplacian.status[i] == PointStatus::active) b.row(i) = laplacian.M[i] * f.row(i);
  }
  return solveBalanced("poisson", laplacian, b, options, report);
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
  checkSizes(function, laplacian);
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
  return solveBalanced(function, laplacian, b, options, report);
}

}  // namespace tufted
