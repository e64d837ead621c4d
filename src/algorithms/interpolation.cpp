#include "tufted/interpolation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/connected.h"
#include "algorithms/greater.h"
#include "algorithms/linear_system.h"
#include "algorithms/nearly_disconnected.h"
#include "algorithms/pinned_system.h"
#include "algorithms/remainder.h"
#include "base/number_text.h"
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
/// A last correction above this part of the range means that digits are wrong: those that are promised.
constexpr double stalled = 1e-12;
/// Masses below this part of the mean count as that much where they are divided by: zero areas would bend nothing.
constexpr double least_mass = 1e-9;

/// The row of b - A u; u without the mean of the component's pins, so that its digits are those of their differences.
using Missing = std::function<Eigen::RowVectorXd(const Eigen::MatrixXd& u, int point)>;

/// A pinned system that is solved again for what is missing until nothing is. Far more accurate than one solve, as what
/// is missing comes from differences of neighbours.
class Refinement {
 public:
  /// @param right N x c; b
  Refinement(const SystemNames& names, const PinnedSystem& pinned, Missing missing, const Eigen::MatrixXd& right,
             const SolverOptions& options)
      : names_(names),
        pinned_(pinned),
        missing_(std::move(missing)),
        right_(right),
        options_(options),
        in_factor_(pinned.free),
        u_(pinned.values) {
    options_.tolerance = std::min(options.tolerance, correction_tolerance);
    for (const int i : pinned_.components.points) {
      const auto mean = pinned_.means.row(pinned_.components.of[i]);
      if (pinned_.pinned[i] != 0) u_.row(i) -= mean;
      if (pinned_.free[i] != 0) u_.row(i).setZero();
    }
  }

  /// Finds constants on badly joined parts without a pin by themselves: for L alone.
  void separateParts(const Laplacian& laplacian) {
    const Components parts = findParts(laplacian);
    if (parts.count == pinned_.components.count) return;
    std::vector<std::uint8_t> floating(parts.count, 0);
    for (const int i : parts.points) floating[parts.of[i]] |= pinned_.free[i];
    for (const int i : parts.points)
      if (pinned_.pinned[i] != 0) floating[parts.of[i]] = 0;
    std::vector<bool> begun(parts.count, false);
    for (const int i : parts.points) {
      if (floating[parts.of[i]] == 0 || begun[parts.of[i]]) continue;
      in_factor_[i] = 0;
      begun[parts.of[i]] = true;
    }
    joints_.emplace(laplacian.L, pinned_.components, parts, floating);
    if (!joints_->isDefinite()) fail("L is not positive semidefinite; validate() names what is wrong with it");
  }

  /// @param A its rows and columns of free points make the system
  /// @param made gets all but the seconds
  Eigen::MatrixXd run(const SparseMatrix& A, SolveReport& made) {
    SparseMatrix within = A;
    within.prune([&](Eigen::Index i, Eigen::Index j, double) { return in_factor_[i] != 0 && in_factor_[j] != 0; });
    const LinearSystem system = LinearSystem::positiveDefinite(names_, within, options_);
    is_iterative_ = system.report().iterative;
    open_ = last_ = Eigen::MatrixXd::Ones(pinned_.means.rows(), pinned_.means.cols());
    last_ *= std::numeric_limits<double>::infinity();
    Eigen::RowVectorXd first;
    for (int round = 0; round < most_corrections; ++round) {
      Eigen::MatrixXd rest = missing(u_, open_);
      if (round == 0) first = norms(rest);
      if (rest.isZero(0)) break;
      Eigen::MatrixXd step = Eigen::MatrixXd::Zero(u_.rows(), u_.cols());
      if (joints_) {
        step = joints_->solve(rest);
        rest = missing(u_ + step, open_);
      }
      for (const int i : pinned_.components.points)
        if (in_factor_[i] == 0) rest.row(i).setZero();
      const Eigen::MatrixXd scale = pinned_.components.normalise(rest);
      SolveReport solved;
      Eigen::MatrixXd within_parts = system.solve(names_.function, rest, &solved, options_.progress, Refine::never);
      pinned_.components.multiply(within_parts, scale);
      step += within_parts;
      add(step, round + 1 == most_corrections);
      made.iterations += solved.iterations;
    }
    made.method = system.report().method;
    measure(A, first, made);
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

  /// What the solution leaves.
  /// @param first norms of what was missing at first
  void measure(const SparseMatrix& A, const Eigen::RowVectorXd& first, SolveReport& made) const {
    const Eigen::MatrixXd rest = missing(u_, Eigen::MatrixXd::Ones(open_.rows(), open_.cols()));
    const Eigen::RowVectorXd left = norms(rest);
    for (Eigen::Index c = 0; c < left.size(); ++c)
      if (first[c] > 0) made.residual = greater(made.residual, left[c] / first[c]);
    made.backward_error = backwardError(A, rest, right_, u_);
    if (made.backward_error <= most_backward_error || (is_iterative_ && made.residual <= options_.tolerance)) return;
    const std::string error = "the backward error |b - A x| / (|A| |x| + |b|) is " + numberText(made.backward_error) +
                              ", must be " + numberText(most_backward_error) + "; " + advice();
    fail(error.c_str());
  }

  /// At the free points, of components and columns where `wanted` is 1.
  Eigen::MatrixXd missing(const Eigen::MatrixXd& u, const Eigen::MatrixXd& wanted) const {
    Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(u.rows(), u.cols());
    for (const int i : pinned_.components.points)
      if (pinned_.free[i] != 0) rest.row(i) = missing_(u, i).cwiseProduct(wanted.row(pinned_.components.of[i]));
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
    if (is_last ? wrong.any() : (wrong && open_.array() == 0).any()) {
      const std::string error =
          "corrections do not become small, so digits are wrong; the matrix is too close to singular; " + advice();
      fail(error.c_str());
    }
    open_ = (largest.array() > negligible * range.array()).select(open_, 0);
    last_ = largest;
  }

  std::string advice() const {
    return is_iterative_ ? "set method to SolverMethod::cholesky, or pin more points" : "pin more points";
  }
  [[noreturn]] void fail(const char* what) const { throw SolverFailure(names_.function + ": " + what); }

  const SystemNames& names_;
  const PinnedSystem& pinned_;
  Missing missing_;
  const Eigen::MatrixXd& right_;
  SolverOptions options_;
  std::vector<std::uint8_t> in_factor_;  ///< N; the free points but the first of each part that joints_ is for
  std::optional<PartConstants> joints_;
  bool is_iterative_ = false;
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
  if (!(made.residual <= large_residual)) made.weak_joint = weakestJoint(laplacian.L);
  made.seconds = watch.seconds();
  if (report != nullptr) *report = made;
  return u;
}

/// M f, 0 at points that are not active.
Eigen::MatrixXd weighted(const Laplacian& laplacian, const Eigen::MatrixXd& f) {
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(f.rows(), f.cols());
  for (Eigen::Index i = 0; i < f.rows(); ++i) {
    if (laplacian.status[i] == PointStatus::active) b.row(i) = laplacian.M[i] * f.row(i);
  }
  return b;
}

/// Corrections make a solve exact whatever the tolerance, so another one would not help.
constexpr const char* if_slow = "raise max_iterations, or set method to SolverMethod::cholesky";

/// L u = b at free points.
Eigen::MatrixXd solveWithPins(const std::string& function, const Laplacian& laplacian, const Pins& pins,
                              const Eigen::MatrixXd* f, const SolverOptions& options, SolveReport* report) {
  const Stopwatch watch;
  const SystemNames names = {.function = function, .matrix = "L", .if_slow = if_slow};
  const PinnedSystem pinned = pinnedSystem(function, laplacian, pins);
  const Eigen::MatrixXd b =
      f != nullptr ? weighted(laplacian, *f) : Eigen::MatrixXd::Zero(pinned.values.rows(), pinned.values.cols());
  const Missing missing = [&](const Eigen::MatrixXd& u, int i) -> Eigen::RowVectorXd {
    return b.row(i) - rowOfDifferences(laplacian.L, u, i);
  };
  SolveReport made;
  Refinement refinement(names, pinned, missing, b, options);
  refinement.separateParts(laplacian);
  Eigen::MatrixXd u = refinement.run(laplacian.L, made);
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
                          .solve(function, b, &made, options.progress, Refine::always);
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
  const SparseMatrix scaled = inverse.asDiagonal() * laplacian.L;
  const SparseMatrix bending = SparseMatrix(laplacian.L * scaled);
  const SparseMatrix& L = laplacian.L;
  const Missing missing = [&](const Eigen::MatrixXd& u, int i) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(u.cols());
    for (SparseMatrix::InnerIterator entry(L, i); entry; ++entry) {
      const int j = static_cast<int>(entry.row());
      sum -= entry.value() * inverse[j] * rowOfDifferences(L, u, j);
    }
    return sum;
  };
  const Eigen::MatrixXd b = Eigen::MatrixXd::Zero(pinned.values.rows(), pinned.values.cols());
  SolveReport made;
  Eigen::MatrixXd u = Refinement(names, pinned, missing, b, options).run(bending, made);
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
  return solveBalanced("poisson", laplacian, weighted(laplacian, f), options, report);
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
