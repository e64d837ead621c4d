#include "algorithms/refinement.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "algorithms/greater.h"
#include "algorithms/remainder.h"
#include "base/number_text.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// The most solves for what is missing; rarely more than two are needed until that is negligible.
constexpr int most_corrections = 6;
constexpr double negligible = 1e-15;  // of the values' range
/// The largest tolerance of conjugate gradients, so that corrections become small fast.
constexpr double correction_tolerance = 1e-10;

Eigen::RowVectorXd norms(const Eigen::MatrixXd& values) {
  Eigen::RowVectorXd result(values.cols());
  for (Eigen::Index c = 0; c < values.cols(); ++c) result[c] = values.col(c).stableNorm();
  return result;
}

}  // namespace

Refinement::Refinement(const SystemNames& names, const PinnedSystem& pinned, Missing missing,
                       const Eigen::MatrixXd& right, double promised, const SolverOptions& options)
    : names_(names),
      pinned_(pinned),
      missing_(std::move(missing)),
      right_(right),
      promised_(promised),
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

void Refinement::separateParts(const Laplacian& laplacian) {
  Components parts = findParts(laplacian);
  if (parts.count == pinned_.components.count) return;
  floating_.assign(parts.count, 0);
  for (const int i : parts.points) floating_[parts.of[i]] |= pinned_.free[i];
  for (const int i : parts.points)
    if (pinned_.pinned[i] != 0) floating_[parts.of[i]] = 0;
  std::vector<bool> begun(parts.count, false);
  for (const int i : parts.points) {
    if (floating_[parts.of[i]] == 0 || begun[parts.of[i]]) continue;
    in_factor_[i] = 0;
    begun[parts.of[i]] = true;
  }
  const std::vector<int>& of = pinned_.components.of;
  L_ = laplacian.L;
  L_.prune([&](Eigen::Index i, Eigen::Index j, double) { return of[i] == of[j]; });
  parts_ = std::move(parts);
}

std::vector<int> Refinement::freePoints() const {
  std::vector<int> points;
  for (const int i : pinned_.components.points)
    if (pinned_.free[i] != 0) points.push_back(i);
  return points;
}

Eigen::MatrixXd Refinement::run(const SparseMatrix& A, SolveReport& made) {
  SparseMatrix within = A;
  within.prune([&](Eigen::Index i, Eigen::Index j, double) { return in_factor_[i] != 0 && in_factor_[j] != 0; });
  const LinearSystem system = LinearSystem::positiveDefinite(names_, within, options_);
  is_iterative_ = system.report().iterative;
  const PartConstants::Inner inner = [&](Eigen::MatrixXd rest) {
    if (rest.cols() == 0) return rest;  // no part floats
    for (const int i : pinned_.components.points)
      if (in_factor_[i] == 0) rest.row(i).setZero();
    const Eigen::MatrixXd scale = pinned_.components.normalise(rest);
    SolveReport solved;
    Eigen::MatrixXd step = system.solve(names_.function, rest, &solved, options_.progress, Refine::never);
    pinned_.components.multiply(step, scale);
    made.iterations += solved.iterations;
    return step;
  };
  const std::vector<int> points = freePoints();
  std::optional<PartConstants> joints;
  if (parts_.count > 0) joints.emplace(L_, points, parts_, floating_, inner);
  if (joints && !joints->isDefinite()) fail(names_.matrix + " is not positive semidefinite; " + names_.if_indefinite);
  open_ = last_ = Eigen::MatrixXd::Ones(pinned_.means.rows(), pinned_.means.cols());
  last_ *= std::numeric_limits<double>::infinity();
  Eigen::RowVectorXd first;
  for (int round = 0; round < most_corrections; ++round) {
    const Eigen::MatrixXd rest = missing(u_, open_);
    if (round == 0) first = norms(rest);
    if (rest.isZero(0)) break;
    add(joints ? joints->solve(L_, points, rest, inner) : inner(rest), round + 1 == most_corrections);
  }
  made.method = system.report().method;
  measure(A, first, made);
  Eigen::MatrixXd result = pinned_.values;
  for (const int i : pinned_.components.points)
    if (pinned_.free[i] != 0) result.row(i) = pinned_.means.row(pinned_.components.of[i]) + u_.row(i);
  return result;
}

void Refinement::measure(const SparseMatrix& A, const Eigen::RowVectorXd& first, SolveReport& made) const {
  const Eigen::MatrixXd rest = missing(u_, Eigen::MatrixXd::Ones(open_.rows(), open_.cols()));
  const Eigen::RowVectorXd left = norms(rest);
  for (Eigen::Index c = 0; c < left.size(); ++c)
    if (first[c] > 0) made.residual = greater(made.residual, left[c] / first[c]);
  made.backward_error = backwardError(A, rest, right_, u_);
  if (made.backward_error <= most_backward_error || (is_iterative_ && made.residual <= options_.tolerance)) return;
  fail("the backward error |b - A x| / (|A| |x| + |b|) is " + numberText(made.backward_error) + ", must be " +
       numberText(most_backward_error) + "; " + advice());
}

Eigen::MatrixXd Refinement::missing(const Eigen::MatrixXd& u, const Eigen::MatrixXd& wanted) const {
  Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(u.rows(), u.cols());
  for (const int i : pinned_.components.points)
    if (pinned_.free[i] != 0) rest.row(i) = missing_(u, i).cwiseProduct(wanted.row(pinned_.components.of[i]));
  if (!rest.allFinite()) fail("sums of values overflow; scale them down");
  return rest;
}

void Refinement::add(const Eigen::MatrixXd& step, bool is_last) {
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
  const auto wrong = largest.array() > promised_ * range.array();
  if (is_last ? wrong.any() : (wrong && open_.array() == 0).any()) {
    fail("corrections do not become small, so digits are wrong; the matrix is too close to singular; " + advice());
  }
  open_ = (largest.array() > negligible * range.array()).select(open_, 0);
  last_ = largest;
}

std::string Refinement::advice() const {
  return is_iterative_ ? "set method to SolverMethod::cholesky, or pin more points" : "pin more points";
}

void Refinement::fail(const std::string& what) const {
  throw SolverFailure(names_.function + ": " + what);
}

}  // namespace tufted
