#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <vector>

#include "algorithms/greater.h"
#include "algorithms/linear_system.h"
#include "base/number_text.h"
#include "base/stage_clock.h"
#include "tufted/errors.h"

// Solves with a LinearSystem and corrects solutions; linear_system.cpp makes the system.
namespace tufted {
namespace {

/// Right sides that are solved together, with any number of threads: each takes half the time of a single one; with 16
/// together it takes the same.
constexpr Eigen::Index columns_per_block = 8;

/// The most corrections of a solution; rarely more than three are needed.
constexpr int most_corrections = 10;
/// A correction below this part of the largest value is the last.
constexpr double negligible = 1e-15;
/// Sums of right sides below this part of an entry are rounding that the entry may absorb.
constexpr double last_digits = 1e-15;

}  // namespace

// The functions below treat column by column in one pass each, because they take as long as some solves.

/// Sums over components by compensated summation (Kahan). An error in these sums of a right side stays in the pinned
/// rows and cannot be corrected later.
VectorXd LinearSystem::exactSums(const Eigen::Ref<const VectorXd>& values) const {
  VectorXd sums = VectorXd::Zero(components_->count), lost = sums;
  for (const int i : components_->points) {
    const int component = components_->of[i];
    const double added = values[i] - lost[component], sum = sums[component] + added;
    lost[component] = (sum - sums[component]) - added;
    sums[component] = sum;
  }
  return sums;
}

LinearSystem::RightSides LinearSystem::rightSides(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  RightSides right;
  if (!components_) {
    right.values = b(unknowns_.point, Eigen::all);
    right.size = right.values.cwiseAbs();
    return right;
  }
  right.values = right.size = Eigen::MatrixXd::Zero(b.rows(), b.cols());
  for (Eigen::Index c = 0; c < b.cols(); ++c) {
    const VectorXd sums = exactSums(b.col(c));
    for (const int i : components_->points) {
      const double taken_out = weights_[i] * sums[components_->of[i]];
      right.values(i, c) = b(i, c) - taken_out;
      right.size(i, c) = std::abs(b(i, c)) + std::abs(taken_out);
    }
    // Rounding leaves sums other than 0, for which no x exists. They are subtracted from the last digits of large
    // entries.
    VectorXd left = exactSums(right.values.col(c));
    for (const int i : components_->points) {
      double& sum = left[components_->of[i]];
      if (sum == 0 || std::abs(sum) > last_digits * right.size(i, c)) continue;
      const double before = right.values(i, c);
      right.values(i, c) -= sum;
      sum -= before - right.values(i, c);
    }
  }
  return right;
}

void LinearSystem::balance(const Eigen::Ref<const VectorXd>& size, const Eigen::Ref<const VectorXd>& x,
                           Eigen::Ref<VectorXd> rest) const {
  VectorXd share = VectorXd::Zero(size.size());
  for (const int i : components_->points) share[i] = size[i] + L_.coeff(i, i) * std::abs(x[i]);
  const VectorXd sums = exactSums(rest), shares = exactSums(share);
  for (const int i : components_->points) {
    const int component = components_->of[i];
    if (sums[component] != 0) rest[i] -= sums[component] * (share[i] / shares[component]);
  }
}

void LinearSystem::spreadPinned(const Eigen::Ref<const VectorXd>& right, Eigen::Ref<VectorXd> x) const {
  VectorXd missing(components_->count);
  for (int component = 0; component < components_->count; ++component) {
    const int i = pinned_[component];
    double rest = right[i];
    for (SparseMatrix::InnerIterator entry(L_, i); entry; ++entry) rest -= entry.value() * (x[entry.row()] - x[i]);
    missing[component] = rest;
  }
  for (const int i : components_->points) x[i] += missing[components_->of[i]] * spread_[i];
}

Eigen::MatrixXd LinearSystem::withinParts(const Eigen::MatrixXd& right, const Tick& tick, int& iterations) const {
  Eigen::MatrixXd solution = right(unknowns_.point, Eigen::all);
  if (backend_) iterations += backend_->solve(solution, tick);
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(right.rows(), right.cols());
  for (Eigen::Index c = 0; c < x.cols(); ++c)
    for (Eigen::Index k = 0; k < solution.rows(); ++k) x(unknowns_.point[k], c) = solution(k, c);
  return x;
}

Eigen::MatrixXd LinearSystem::approximate(const Eigen::MatrixXd& right, const Tick& tick, int& iterations) const {
  if (!components_) {
    Eigen::MatrixXd x = right;
    if (backend_) iterations += backend_->solve(x, tick);
    return x;
  }
  const auto inner = [&](const Eigen::MatrixXd& rest) { return withinParts(rest, tick, iterations); };
  Eigen::MatrixXd x = joints_ ? joints_->solve(L_, components_->points, right, inner) : inner(right);
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    if (spread_.size() > 0) spreadPinned(right.col(c), x.col(c));
    VectorXd means = VectorXd::Zero(components_->count);
    for (const int i : components_->points) means[components_->of[i]] += weights_[i] * x(i, c);
    for (const int i : components_->points) x(i, c) -= means[components_->of[i]];
  }
  return x;
}

bool LinearSystem::isGood(const Remainder& left, Eigen::Index column) const {
  return left.backward_error[column] <= most_backward_error ||
         (report_.iterative && left.residual[column] <= tolerance_);
}

void LinearSystem::improve(const std::string& function, const RightSides& right, Eigen::MatrixXd& x, Refine refine,
                           const Tick& tick, SolveReport& made) const {
  const bool thorough = refine == Refine::always || joints_;
  const auto largestOf = [](const Eigen::Ref<const VectorXd>& values) {
    return values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0;
  };
  const auto measured = [&](const Eigen::MatrixXd& b, const Eigen::MatrixXd& size, Eigen::MatrixXd& solution) {
    return components_ ? relaxLaplacian(L_, components_->points, b, size, most_backward_error, solution)
                       : remainderOf(lower_, b, solution);
  };
  Remainder left = measured(right.values, right.size, x);
  VectorXd last = VectorXd::Constant(x.cols(), HUGE_VAL);  // largest magnitude in each column's last correction
  std::vector<int> open;                                   // columns still to be corrected
  for (int c = 0; c < x.cols(); ++c)
    if (thorough || !isGood(left, c)) open.push_back(c);
  int rounds = 0;
  for (; !open.empty() && rounds < most_corrections; ++rounds) {
    if (!x.allFinite()) throw SolverFailure(function + ": the solution overflows; scale the right sides down");
    Eigen::MatrixXd rest = left.rest(Eigen::all, open);
    for (std::size_t k = 0; k < open.size() && components_; ++k)
      balance(right.size.col(open[k]), x.col(open[k]), rest.col(static_cast<Eigen::Index>(k)));
    const Eigen::MatrixXd step = approximate(rest, tick, made.iterations);
    std::vector<int> still_open;
    for (std::size_t k = 0; k < open.size(); ++k) {
      const int c = open[k];
      const double largest = largestOf(step.col(static_cast<Eigen::Index>(k)));
      if (!(largest < last[c] / 2)) continue;  // only rounding remains
      Eigen::MatrixXd column = x.col(c) + step.col(static_cast<Eigen::Index>(k));
      const Remainder now = measured(right.values.col(c), right.size.col(c), column);
      x.col(c) = column;
      left.rest.col(c) = now.rest;
      left.residual[c] = now.residual[0];
      left.backward_error[c] = now.backward_error[0];
      // Corrections are taken to shrink by a constant factor.
      const double size = largestOf(x.col(c));
      const bool goes_on = largest * (largest / std::min(last[c], size)) > negligible * size;
      if (thorough ? goes_on : !isGood(left, c)) still_open.push_back(c);
      last[c] = largest;
    }
    open = still_open;
  }
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    made.residual = greater(made.residual, left.residual[c]);
    made.backward_error = greater(made.backward_error, left.backward_error[c]);
    if (isGood(left, c)) continue;
    if (!x.col(c).allFinite()) throw SolverFailure(function + ": the solution overflows; scale the right sides down");
    throw SolverFailure(function + ": the backward error |b - A x| / (|A| |x| + |b|) is " +
                        numberText(left.backward_error[c]) + " after " + std::to_string(rounds) +
                        " corrections, must be " + numberText(most_backward_error) + "; " +
                        (report_.iterative ? names_.if_slow : names_.if_indefinite));
  }
}

void LinearSystem::fail(const std::string& function, const NotConverged& failure) const {
  const std::string bytes =
      report_.factor_bytes > 0 ? " (a factor would take " + bytesText(report_.factor_bytes) + ")" : "";
  throw SolverFailure(function + ": |b - A x| / |b| is " + numberText(failure.residual) + " after " +
                      std::to_string(failure.iterations) + " iterations of multigrid on " + names_.matrix +
                      ", must be " + numberText(tolerance_) + "; " + names_.if_slow + bytes);
}

Eigen::MatrixXd LinearSystem::solve(const std::string& function, const Eigen::Ref<const Eigen::MatrixXd>& b,
                                    SolveReport* report, const Progress& progress, Refine refine) const try {
  const auto n = static_cast<Eigen::Index>(unknowns_.number.size());
  if (b.rows() != n)
    throw InvalidInput(function + ": b has " + std::to_string(b.rows()) + " rows, must have " + std::to_string(n));
  const Stopwatch watch;
  const Eigen::Index blocks = (b.cols() + columns_per_block - 1) / columns_per_block;
  std::vector<SolveReport> done(static_cast<std::size_t>(blocks));
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(n, b.cols());
  const Workers workers(threads_, progress);
  workers.forBlocks("solve", b.cols(), columns_per_block, [&](std::int64_t begin, std::int64_t end, int worker) {
    if (!backend_) return;
    SolveReport& result = done[begin / columns_per_block];
    const RightSides right = rightSides(b.middleCols(begin, end - begin));
    if (!right.values.allFinite()) throw InvalidInput(function + ": b has values that are not finite, must have none");
    const auto total = static_cast<double>(b.cols()), columns = static_cast<double>(end - begin);
    double most_done = 0;
    const Tick tick = [&](double done_here) {
      // Only the caller's own thread reports progress. Corrections would begin again at 0 and are not reported.
      if (worker != 0) return;
      most_done = std::max(most_done, done_here);
      workers.report("solve", (static_cast<double>(begin) + most_done * columns) / total);
    };
    Eigen::MatrixXd solution = approximate(right.values, tick, result.iterations);
    if (refine != Refine::never) improve(function, right, solution, refine, tick, result);
    for (Eigen::Index c = 0; components_ && c < solution.cols(); ++c) x.col(begin + c) = solution.col(c);
    for (Eigen::Index c = 0; !components_ && c < solution.cols(); ++c)
      for (Eigen::Index k = 0; k < solution.rows(); ++k) x(unknowns_.point[k], begin + c) = solution(k, c);
  });
  if (report != nullptr) {
    *report = {.method = report_.method};
    for (const SolveReport& block : done) {
      report->iterations = std::max(report->iterations, block.iterations);
      report->residual = greater(report->residual, block.residual);
      report->backward_error = greater(report->backward_error, block.backward_error);
    }
    if (!(report->residual <= large_residual))
      report->weak_joint = components_ ? weakestJoint(L_) : weakestJoint(lower_, unknowns_.point);
    report->seconds = watch.seconds();
  }
  return x;
} catch (const NotConverged& failure) {
  fail(function, failure);
} catch (const std::bad_alloc&) {
  throw SolverFailure(function + ": memory does not suffice to solve for " + std::to_string(b.cols()) +
                      " right sides; solve for fewer at once, or free what else takes memory");
}

}  // namespace tufted
