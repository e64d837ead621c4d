// Bounded biharmonic weights (Jacobson, Baran, Popovic, Sorkine 2011).
#include "tufted/weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "algorithms/bending.h"
#include "algorithms/coincident.h"
#include "algorithms/connected.h"
#include "algorithms/linear_system.h"
#include "base/parallel.h"
#include "base/stage_clock.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* function_name = "boundedBiharmonicWeights";
/// By how much a weight may leave its bounds.
constexpr double allowed = 1e-9;
/// By how much bending may pull a weight away from its bound, in weights: some thousand times the rounding. It is far
/// less than `allowed`, as a weight alone can hardly move between its neighbours.
constexpr double allowed_pull = 1e-12;
/// After so many exchanges of all points of the wrong kind that do not make them fewer, single ones are exchanged,
/// which ends in any case.
constexpr int patience = 10;

[[noreturn]] void refuse(const std::string& why) {
  throw InvalidInput(std::string(function_name) + ": " + why);
}

/// Of each active point, which handle it belongs to; -1: none.
std::vector<int> handlesOfPoints(const Laplacian& laplacian, const Components& components,
                                 const std::vector<std::vector<int>>& handles) {
  const auto n = static_cast<int>(laplacian.status.size());
  if (handles.empty()) refuse("handles is empty, must name at least one");
  std::vector<int> of(laplacian.status.size(), -1);
  for (std::size_t h = 0; h < handles.size(); ++h) {
    bool has_active = false;
    for (const int point : handles[h]) {
      if (point < 0 || point >= n)
        refuse("handle " + std::to_string(h) + " has point " + std::to_string(point) + ", must lie in [0, " +
               std::to_string(n) + ")");
      const int i = laplacian.representative[point];
      if (components.of[i] < 0) continue;
      has_active = true;
      if (of[i] >= 0 && of[i] != static_cast<int>(h))
        refuse("point " + std::to_string(point) + " is of handle " + std::to_string(of[i]) + " and of handle " +
               std::to_string(h) + ", must be of one");
      of[i] = static_cast<int>(h);
    }
    if (!has_active) refuse("handle " + std::to_string(h) + " has no active point, must have at least one");
  }
  return of;
}

/// The interior point method guesses the bounds: it ends after so many systems, or where the mean product of slack and
/// multiplier is that small, of the mean diagonal.
constexpr int most_guesses = 60;
constexpr double guessed = 1e-22;
/// The part of the way to the nearest bound that one of its steps takes at most.
constexpr double safe_step = 0.995;

enum class State : std::uint8_t { fixed, free, lower, upper };

/// The least bending of one function within [0, 1].
class BoundedProblem {
 public:
  BoundedProblem(const Laplacian& laplacian, const Components& components, const WeightOptions& options)
      : L_(laplacian.L),
        options_(options),
        points_(components.points),
        inverse_(inverseMasses(laplacian, points_)),
        Q_(bendingMatrix(L_, inverse_)),
        diagonal_(Q_.diagonal()) {}

  /// @param is_free 1 at the points that may change
  /// @param[in,out] u N; the values of the others, and the solution
  /// @param[out] residual as WeightReport::residual
  /// @return systems solved
  int solve(const std::vector<std::uint8_t>& is_free, const Progress& progress, VectorXd& u, double& residual) const;

 private:
  /// What bending says about each point, in weights: (Q u)_i / Q_ii, from differences.
  VectorXd pull(const VectorXd& u) const;
  /// Q over some points plus a diagonal, factored.
  LinearSystem factor(const std::vector<State>& state, const VectorXd& added, const Progress& progress) const;
  /// Guesses which points lie at a bound, by an interior point method.
  /// @param[in,out] state free points become lower or upper ones
  /// @return systems solved
  int guess(const Progress& progress, VectorXd u, std::vector<State>& state) const;
  void solveFree(const std::vector<State>& state, const Progress& progress, VectorXd& u) const;
  State wanted(State state, double value, double pulled) const;

  const SparseMatrix& L_;
  const WeightOptions& options_;
  const std::vector<int>& points_;
  VectorXd inverse_;  ///< N; mean mass over mass
  SparseMatrix Q_;    ///< L M^-1 L, in 1 / mean mass
  VectorXd diagonal_;
};

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
  const SystemNames names = {.function = function_name,
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
  VectorXd slack = lower;                                    // 1 - u, which would lose its digits
  for (const int i : free) u[i] = slack[i] = 0.5, lower[i] = upper[i] = unit;
  int iteration = 0;
  while (iteration < most_guesses) {
    double product = 0;
    for (const int i : free) product += (lower[i] * u[i] + upper[i] * slack[i]) / (2 * n);
    if (!(product > guessed * unit)) break;
    ++iteration;
    const VectorXd pulled = pull(u);
    VectorXd added = VectorXd::Zero(u.size());
    for (const int i : free) added[i] = lower[i] / u[i] + upper[i] / slack[i];
    const LinearSystem system = factor(state, added, progress);
    VectorXd du = VectorXd::Zero(u.size()), d_lower = du, d_upper = du;
    // Mehrotra's two steps: straight to the solution, then along what that says about the curve to it.
    const auto step = [&](double aim) {
      VectorXd lower_aim = VectorXd::Zero(u.size()), upper_aim = lower_aim;
      Eigen::MatrixXd right = Eigen::MatrixXd::Zero(u.size(), 1);
      for (const int i : free) {
        lower_aim[i] = (aim - du[i] * d_lower[i]) / u[i];
        upper_aim[i] = (aim + du[i] * d_upper[i]) / slack[i];
        right(i, 0) = -pulled[i] * diagonal_[i] + lower_aim[i] - upper_aim[i];
      }
      du = system.solve(function_name, right, nullptr, progress, Refine::never).col(0);
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
  // What is missing is solved for twice, so that only its rounding is left.
  constexpr int solves = 2;
  for (int k = 0; k < solves; ++k) {
    const VectorXd pulled = pull(u);
    Eigen::MatrixXd missing = Eigen::MatrixXd::Zero(u.size(), 1);
    for (const int i : points_)
      if (is_free(i)) missing(i, 0) = -pulled[i] * diagonal_[i];
    const Eigen::MatrixXd step = system.solve(function_name, missing, nullptr, progress, Refine::never);
    for (const int i : points_)
      if (is_free(i)) u[i] += step(i, 0);
  }
}

State BoundedProblem::wanted(State state, double value, double pulled) const {
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
      throw SolverFailure(std::string(function_name) + ": after " + std::to_string(iteration) + " systems " +
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

/// Points with a value above that of all neighbours.
std::int64_t localMaxima(const Laplacian& laplacian, const std::vector<std::uint8_t>& is_free, const VectorXd& u) {
  std::int64_t count = 0;
  for (int i = 0; i < u.size(); ++i) {
    if (is_free[i] == 0 || !(u[i] > allowed)) continue;
    bool is_highest = true;
    for (SparseMatrix::InnerIterator entry(laplacian.L, i); entry && is_highest; ++entry)
      is_highest = entry.row() == i || u[entry.row()] < u[i] - allowed;
    count += is_highest ? 1 : 0;
  }
  return count;
}

}  // namespace

Eigen::MatrixXd boundedBiharmonicWeights(const Laplacian& laplacian, const std::vector<std::vector<int>>& handles,
                                         const WeightOptions& options, WeightReport* report) {
  const Stopwatch watch;
  checkSizes(function_name, laplacian);
  if (options.max_iterations < 1)
    refuse("max_iterations = " + std::to_string(options.max_iterations) + ", must be at least 1");
  const Components components = findComponents(laplacian);
  const std::vector<int> handle = handlesOfPoints(laplacian, components, handles);
  const Workers workers(options.solver.threads, options.solver.progress);

  WeightReport made;
  const auto count = std::ssize(handles);
  made.handles = count;
  std::vector<std::uint8_t> has_handle(static_cast<std::size_t>(components.count), 0);
  for (const int i : components.points)
    if (handle[i] >= 0) has_handle[components.of[i]] = 1;
  std::vector<std::uint8_t> is_free(laplacian.status.size(), 0);
  for (const int i : components.points) {
    if (has_handle[components.of[i]] == 0)
      ++made.not_reached;
    else if (handle[i] < 0)
      is_free[i] = 1, ++made.free;
  }
  const BoundedProblem problem(laplacian, components, options);
  Eigen::MatrixXd weights =
      Eigen::MatrixXd::Constant(std::ssize(laplacian.status), count, std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index h = 0; h < count; ++h) {
    const double before = static_cast<double>(h) / static_cast<double>(count);
    workers.report("weights", before);
    const Progress within = [&](std::string_view, double) {
      return options.solver.progress == nullptr || options.solver.progress("weights", before);
    };
    VectorXd u = VectorXd::Zero(std::ssize(laplacian.status));
    // Other components than those of the handle are 0, and have nothing to solve.
    std::vector<std::uint8_t> takes_part(static_cast<std::size_t>(components.count), 0);
    for (const int i : components.points) {
      if (handle[i] != h) continue;
      u[i] = 1;
      takes_part[components.of[i]] = 1;
    }
    std::vector<std::uint8_t> changes = is_free;
    for (const int i : components.points)
      if (takes_part[components.of[i]] == 0) changes[i] = 0;
    made.iterations = std::max(made.iterations, problem.solve(changes, within, u, made.residual));
    for (const int i : components.points)
      if (has_handle[components.of[i]] != 0) weights(i, h) = std::clamp(u[i], 0.0, 1.0);
    made.local_maxima += localMaxima(laplacian, changes, u);
  }
  for (const int i : components.points) {
    if (has_handle[components.of[i]] == 0) continue;
    const double sum = weights.row(i).sum();
    made.greatest_sum_error = std::max(made.greatest_sum_error, std::abs(sum - 1));
    if (!(sum > 0))
      throw SolverFailure(std::string(function_name) + ": all weights of point " + std::to_string(i) +
                          " are 0, add a handle near it");
    weights.row(i) /= sum;
  }
  copyToCoincident(laplacian, weights);
  workers.report("done", 1);
  made.seconds = watch.seconds();
  if (report != nullptr) *report = made;
  return weights;
}

}  // namespace tufted
