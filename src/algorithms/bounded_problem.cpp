#include "algorithms/bounded_problem.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* bounded_problem_name = "boundedBiharmonicWeights";  // the only caller
/// A weight at a bound is freed if pull() would move it inwards by more than this, in weights. Rounding is about 1e-15.
/// It is far below `allowed`, because a single weight can hardly move while others stay.
constexpr double allowed_pull = 1e-12;
/// If this many exchanges of all wrong points have not made them fewer, one is exchanged at a time, which always ends.
constexpr int patience = 10;

/// The interior point method solves at most this many systems. It needs 14 to 41.
constexpr int most_guesses = 60;
/// The interior point method ends where the mean product of slack and multiplier is this part of the mean diagonal: at
/// 16,000 points multipliers are as small as 1e-7, and with 1e-12 it left 163 points free that lie at a bound.
constexpr double guessed = 1e-22;
/// The part of the way to the nearest bound that a step of the interior point method takes at most; the value of
/// Mehrotra.
constexpr double safe_step = 0.995;

}  // namespace

VectorXd BoundedProblem::pull(const VectorXd& u) const {
  const auto rowOf = [&](const VectorXd& values, int i) {
    double sum = 0;
    for (SparseMatrix::InnerIterator entry(L_, i); entry; ++entry)
      if (entry.row() != i) sum += entry.value() * (values[entry.row()] - values[i]);
    return sum;
  };
  VectorXd bending = VectorXd::Zero(u.size()), result = bending;
  for (const int i : points_) bending[i] = inverse_[i] * rowOf(u, i);
  for (const int i : points_)
    if (diagonal_[i] > 0) result[i] = rowOf(bending, i) / diagonal_[i];
  return result;
}

LinearSystem BoundedProblem::factor(const std::vector<State>& state, const VectorXd& added,
                                    const Progress& progress) const {
  const auto is_free = [&](Eigen::Index i) { return state[static_cast<std::size_t>(i)] == State::free; };
  SparseMatrix within = Q_;
  within.prune([&](Eigen::Index i, Eigen::Index j, double) { return is_free(i) && is_free(j); });
  for (int i = 0; added.size() > 0 && i < within.outerSize(); ++i)
    for (SparseMatrix::InnerIterator entry(within, i); entry; ++entry)
      if (entry.row() == i) entry.valueRef() += added[i];
  const SystemNames names = {.function = bounded_problem_name,
                             .matrix = "L M^-1 L",
                             .if_large = "take fewer points",
                             .if_too_large = IfTooLarge::refuse};
  SolverOptions solver = options_.solver;
  solver.progress = progress;
  return LinearSystem::positiveDefinite(names, within, solver);
}

int BoundedProblem::guess(const Progress& progress, VectorXd u, std::vector<State>& state) const {
  std::vector<int> free;
  double unit = 0;
  for (const int i : points_)
    if (state[i] == State::free) free.push_back(i), unit += diagonal_[i];
  if (free.empty()) return 0;
  const auto n = static_cast<double>(free.size());
  unit /= n;
  VectorXd lower = VectorXd::Zero(u.size()), upper = lower;  // multipliers
  VectorXd slack = lower;  // 1 - u, kept separately because the subtraction would cancel digits
  for (const int i : free) u[i] = slack[i] = 0.5, lower[i] = upper[i] = unit;
  std::optional<LinearSystem> system;
  int iteration = 0;
  while (iteration < most_guesses) {
    double product = 0;
    for (const int i : free) product += (lower[i] * u[i] + upper[i] * slack[i]) / (2 * n);
    if (!(product > guessed * unit)) break;
    ++iteration;
    const VectorXd pulled = pull(u);
    VectorXd added = VectorXd::Zero(u.size());
    for (const int i : free) added[i] = lower[i] / u[i] + upper[i] / slack[i];
    if (system)
      system->setDiagonal(diagonal_ + added);
    else
      system.emplace(factor(state, added, progress));
    VectorXd du = VectorXd::Zero(u.size()), d_lower = du, d_upper = du;
    // Mehrotra's predictor (aim 0), then the corrector, whose second-order terms come from the predictor.
    const auto step = [&](double aim) {
      VectorXd lower_aim = VectorXd::Zero(u.size()), upper_aim = lower_aim;
      Eigen::MatrixXd right = Eigen::MatrixXd::Zero(u.size(), 1);
      for (const int i : free) {
        lower_aim[i] = (aim - du[i] * d_lower[i]) / u[i];
        upper_aim[i] = (aim + du[i] * d_upper[i]) / slack[i];
        right(i, 0) = -pulled[i] * diagonal_[i] + lower_aim[i] - upper_aim[i];
      }
      du = system->solve(bounded_problem_name, right, nullptr, progress, Refine::never).col(0);
      double length = 1;
      const auto bound = [&](double value, double change) {
        if (change < 0) length = std::min(length, -value / change);
      };
      for (const int i : free) {
        d_lower[i] = lower_aim[i] - lower[i] - lower[i] / u[i] * du[i];
        d_upper[i] = upper_aim[i] - upper[i] + upper[i] / slack[i] * du[i];
        bound(u[i], du[i]);
        bound(slack[i], -du[i]);
        bound(lower[i], d_lower[i]);
        bound(upper[i], d_upper[i]);
      }
      return length;
    };
    const double straight = step(0);
    double ahead = 0;
    for (const int i : free)
      ahead += ((lower[i] + straight * d_lower[i]) * (u[i] + straight * du[i]) +
                (upper[i] + straight * d_upper[i]) * (slack[i] - straight * du[i])) /
               (2 * n);
    const double length = safe_step * step(product * std::pow(ahead / product, 3));
    if (!std::isfinite(length)) break;
    for (const int i : free) {
      u[i] += length * du[i];
      slack[i] -= length * du[i];
      lower[i] += length * d_lower[i];
      upper[i] += length * d_upper[i];
    }
  }
  for (const int i : free) {
    if (lower[i] > u[i] * diagonal_[i]) state[i] = State::lower;
    if (upper[i] > slack[i] * diagonal_[i]) state[i] = State::upper;
  }
  return iteration;
}

void BoundedProblem::solveFree(const std::vector<State>& state, const Progress& progress, VectorXd& u) const {
  const auto is_free = [&](Eigen::Index i) { return state[static_cast<std::size_t>(i)] == State::free; };
  if (std::none_of(state.begin(), state.end(), [](State s) { return s == State::free; })) return;
  const LinearSystem system = factor(state, {}, progress);
  // The second solve corrects the residual of the first.
  constexpr int solves = 2;
  for (int k = 0; k < solves; ++k) {
    const VectorXd pulled = pull(u);
    Eigen::MatrixXd missing = Eigen::MatrixXd::Zero(u.size(), 1);
    for (const int i : points_)
      if (is_free(i)) missing(i, 0) = -pulled[i] * diagonal_[i];
    const Eigen::MatrixXd step = system.solve(bounded_problem_name, missing, nullptr, progress, Refine::never);
    for (const int i : points_)
      if (is_free(i)) u[i] += step(i, 0);
  }
}

BoundedProblem::State BoundedProblem::wanted(State state, double value, double pulled) const {
  switch (state) {
    case State::free:
      return value < -allowed ? State::lower : value > 1 + allowed ? State::upper : State::free;
    case State::lower:
      return pulled < -allowed_pull ? State::free : State::lower;
    case State::upper:
      return pulled > allowed_pull ? State::free : State::upper;
    default:
      return state;
  }
}

int BoundedProblem::solve(const std::vector<std::uint8_t>& is_free, const Progress& progress, VectorXd& u,
                          double& residual) const {
  std::vector<State> state(is_free.size(), State::fixed);
  for (std::size_t i = 0; i < is_free.size(); ++i)
    if (is_free[i] != 0) state[i] = State::free;
  const int guesses = guess(progress, u, state);
  for (std::size_t i = 0; i < state.size(); ++i)
    if (is_free[i] != 0) u[static_cast<Eigen::Index>(i)] = state[i] == State::upper ? 1 : 0;
  std::size_t fewest = is_free.size() + 1;
  int left = patience;
  for (int iteration = guesses + 1;; ++iteration) {
    solveFree(state, progress, u);
    const VectorXd pulled = pull(u);
    std::vector<int> wrong;
    for (const int i : points_)
      if (wanted(state[i], u[i], pulled[i]) != state[i]) wrong.push_back(i);
    if (wrong.empty()) {
      for (const int i : points_) {
        const double off = state[i] == State::free    ? std::abs(pulled[i])
                           : state[i] == State::lower ? std::max(-pulled[i], 0.0)
                           : state[i] == State::upper ? std::max(pulled[i], 0.0)
                                                      : 0;
        residual = std::max(residual, off);
      }
      return iteration;
    }
    if (iteration >= options_.max_iterations)
      throw SolverFailure(std::string(bounded_problem_name) + ": after " + std::to_string(iteration) + " systems " +
                          std::to_string(wrong.size()) + " points have no bound yet, raise max_iterations");
    if (wrong.size() < fewest) {
      fewest = wrong.size();
      left = patience;
    } else if (left > 0) {
      --left;
    } else {
      wrong.erase(wrong.begin(), wrong.end() - 1);
    }
    for (const int i : wrong) {
      state[i] = wanted(state[i], u[i], pulled[i]);
      if (state[i] == State::lower) u[i] = 0;
      if (state[i] == State::upper) u[i] = 1;
    }
  }
}

}  // namespace tufted
