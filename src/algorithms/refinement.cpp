#include "algorithms/refinement.h"

#include <limits>
#include <utility>

#include "algorithms/greater.h"
#include "algorithms/remainder.h"
#include "base/number_text.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// Maximum number of solves, the first one included; more than two are rarely needed.
constexpr int most_solves = 6;
/// A correction below this part of the range of the values is the last.
constexpr double last_correction = 1e-15;

Eigen::RowVectorXd norms(const Eigen::MatrixXd& values) {
  Eigen::RowVectorXd result(values.cols());
  for (Eigen::Index c = 0; c < values.cols(); ++c) result[c] = values.col(c).stableNorm();
  return result;
}

}  // namespace

Refinement::Refinement(std::string function, const PinnedSolver& solver, const PinnedValues& given, Missing missing,
                       const Eigen::MatrixXd& right, double promised)
    : function_(std::move(function)),
      solver_(solver),
      pinned_(solver.pinned()),
      given_(given),
      missing_(std::move(missing)),
      right_(right),
      promised_(promised),
      u_(given.values) {
  for (const int i : pinned_.components.points)
    if (pinned_.pinned[i] != 0) u_.row(i) -= given_.means.row(pinned_.components.of[i]);
  for (const int i : solver_.freePoints()) u_.row(i).setZero();
}

Eigen::MatrixXd Refinement::run(const SparseMatrix& A, const Progress& progress, SolveReport& made) {
  open_ = last_ = Eigen::MatrixXd::Ones(given_.means.rows(), given_.means.cols());
  last_ *= std::numeric_limits<double>::infinity();
  Eigen::RowVectorXd first;
  for (int round = 0; round < most_solves; ++round) {
    const Eigen::MatrixXd rest = missing(u_, open_);
    if (round == 0) first = norms(rest);
    if (rest.isZero(0)) break;
    add(solver_.solve(function_, rest, progress, made.iterations), round + 1 == most_solves);
  }
  made.method = solver_.report().method;
  measure(A, first, made);
  Eigen::MatrixXd result = given_.values;
  for (const int i : solver_.freePoints()) result.row(i) = given_.means.row(pinned_.components.of[i]) + u_.row(i);
  return result;
}

void Refinement::measure(const SparseMatrix& A, const Eigen::RowVectorXd& first, SolveReport& made) const {
  const Eigen::MatrixXd rest = missing(u_, Eigen::MatrixXd::Ones(open_.rows(), open_.cols()));
  const Eigen::RowVectorXd left = norms(rest);
  for (Eigen::Index c = 0; c < left.size(); ++c)
    if (first[c] > 0) made.residual = greater(made.residual, left[c] / first[c]);
  made.backward_error = backwardError(A, rest, right_, u_);
  if (made.backward_error <= most_backward_error ||
      (solver_.report().iterative && made.residual <= solver_.tolerance()))
    return;
  fail("the backward error |b - A x| / (|A| |x| + |b|) is " + numberText(made.backward_error) + ", must be " +
       numberText(most_backward_error) + "; " + advice());
}

Eigen::MatrixXd Refinement::missing(const Eigen::MatrixXd& u, const Eigen::MatrixXd& wanted) const {
  Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(u.rows(), u.cols());
  for (const int i : solver_.freePoints())
    rest.row(i) = missing_(u, i).cwiseProduct(wanted.row(pinned_.components.of[i]));
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
  for (const int i : solver_.freePoints()) raise(largest, step, i);
  open_ = (largest.array() < last_.array() / 2).select(open_, 0);
  for (const int i : pinned_.components.points) {
    if (pinned_.free[i] != 0) u_.row(i) += step.row(i).cwiseProduct(open_.row(pinned_.components.of[i]));
    if (pinned_.free[i] + pinned_.pinned[i] != 0) raise(range, u_, i);
  }
  const auto wrong = largest.array() > promised_ * range.array();
  if (is_last ? wrong.any() : (wrong && open_.array() == 0).any()) {
    fail("corrections do not become small, so digits are wrong; the matrix is too close to singular; " + advice());
  }
  open_ = (largest.array() > last_correction * range.array()).select(open_, 0);
  last_ = largest;
}

std::string Refinement::advice() const {
  return solver_.report().iterative ? "set method to SolverMethod::cholesky, or pin more points" : "pin more points";
}

void Refinement::fail(const std::string& what) const {
  throw SolverFailure(function_ + ": " + what);
}

}  // namespace tufted
