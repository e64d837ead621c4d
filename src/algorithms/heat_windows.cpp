// Step 1 of the heat method (Crane, Weischedel, Wardetzky 2013, 2017), the spread of heat, in windows, for systems too
// large for a factor.
#include "algorithms/heat_windows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/greater.h"

namespace tufted {
namespace {

/// First and least width of a window in edges. Heat falls to 1e-61 over `first_layers` edges of mean length. If a
/// factor of a window does not fit, windows shrink to the width that conjugate gradients resolve.
constexpr int first_layers = 128, least_layers = 32;
/// Heat is accurate above this part of the window's largest value: with a factor down to underflow, with conjugate
/// gradients down to their tolerance.
constexpr double valid_by_factor = 1e-285, valid_by_iteration = 1e-9;
/// Heat is accurate above this many times the greatest heat of the window's last layer. Beyond that layer it is taken
/// for 0; the relative error is the square of their ratio.
constexpr double above_outer = 1e6;
/// The next round starts at this many times the least accurate heat, so that faces across the front are accurate at all
/// corners.
constexpr double front_above_valid = 1e4;
/// A window whose front would lie above this part of its greatest heat is widened: its edges are short and it is too
/// narrow.
constexpr double highest_front = 1e-3;
/// The logarithm of heat over that at the front is cut off here: exp overflows above 709.
constexpr double hottest = 600;
constexpr double nothing = -std::numeric_limits<double>::infinity();

}  // namespace

HeatWindows::HeatWindows(const std::string& function, const HeatProblem& problem, const VectorXd& heat,
                         const Progress& progress, DistanceReport& report)
    : function_(function),
      problem_(problem),
      progress_(progress),
      report_(report),
      layers_(first_layers),
      heat_(heat),
      u_(VectorXd::Zero(heat.size())),
      passed_(static_cast<std::size_t>(heat.size()), 0),
      number_(static_cast<std::size_t>(heat.size()), -1) {
  log_heat_ = VectorXd::Constant(heat.size(), nothing);
}

bool HeatWindows::next() {
  if (report_.rounds > 0 && !restart()) return false;
  ++report_.rounds;
  scalePassed(problem_.components.normalise(heat_));
  for (;;) {
    findWindow();
    const Eigen::VectorXd largest = solve();
    double outer = 0;
    for (std::size_t k = outer_; k < window_.size(); ++k) outer = std::max(outer, u_[window_[k]]);
    const double valid = std::max(by_factor_ ? valid_by_factor : valid_by_iteration, above_outer * outer);
    if (front_above_valid * valid <= highest_front) {
      scalePassed(largest);
      log_valid_ = std::log(valid);
      log_front_ = std::log(front_above_valid * valid);
      break;
    }
    layers_ *= 2;
  }
  for (const int i : window_) log_heat_[i] = std::log(u_[i]);  // -infinity without heat
  if (!by_factor_) layers_ = std::max(least_layers, layers_ / 2);
  return true;
}

/// Scales the heat of points passed in earlier rounds as that of the points ahead.
/// @param factors by component, the divisors of the heat ahead
void HeatWindows::scalePassed(const Eigen::VectorXd& factors) {
  for (const int i : problem_.components.points)
    if (passed_[i] != 0) log_heat_[i] -= std::log(factors[problem_.components.of[i]]);
}

/// Finds the points ahead by breadth-first search from those that heat flows into.
void HeatWindows::findWindow() {
  // Marks a vertex that was visited.
  constexpr int seen = -2;
  window_.clear();
  for (const int i : problem_.components.points) {
    if (!(heat_[i] > 0)) continue;
    window_.push_back(i);
    number_[i] = seen;
  }
  std::size_t layer = 0;
  for (int done = 1; done < layers_ && layer < window_.size(); ++done) {
    const std::size_t end = window_.size();
    for (; layer < end; ++layer) {
      for (SparseMatrix::InnerIterator entry(problem_.L, window_[layer]); entry; ++entry) {
        const auto j = entry.row();
        const bool joined = problem_.components.of[j] == problem_.components.of[window_[layer]] && entry.value() != 0;
        if (!joined || number_[j] == seen || passed_[j] != 0) continue;
        number_[j] = seen;
        window_.push_back(static_cast<int>(j));
      }
    }
  }
  outer_ = layer;  // the end of the window if nothing lies beyond it
  for (const int i : window_) number_[i] = -1;
}

/// Solves over the window and adds half of the solution to `u_`, or all of it if the surface does not end.
/// @param open leaves out the points where the surface ends
void HeatWindows::solveSystem(bool open) {
  std::vector<int> points;
  for (const int i : window_) {
    if (open && problem_.system.interior[i] == 0) continue;
    number_[i] = static_cast<int>(points.size());
    points.push_back(i);
  }
  const auto n = static_cast<int>(points.size());
  SparseMatrix A(n, n);
  std::vector<Eigen::Triplet<double>> entries;
  VectorXd heat(n);
  for (int k = 0; k < n; ++k) {
    heat[k] = heat_[points[k]];
    for (SparseMatrix::InnerIterator entry(problem_.system.matrix, points[k]); entry; ++entry)
      if (number_[entry.row()] >= 0) entries.emplace_back(number_[entry.row()], k, entry.value());
  }
  for (const int i : window_) number_[i] = -1;
  A.setFromTriplets(entries.begin(), entries.end());
  SolverOptions options = problem_.system.window;
  options.progress = progress_;
  const LinearSystem system = LinearSystem::positiveDefinite(
      {.function = function_, .matrix = "M + t L", .if_slow = "raise max_iterations or memory_limit"}, A, options);
  SolveReport solved;
  const VectorXd u = system.solve(function_, heat, &solved, progress_);
  by_factor_ = by_factor_ && !system.report().iterative;
  report_.iterations = std::max(report_.iterations, solved.iterations);
  report_.residual = greater(report_.residual, solved.residual);
  report_.backward_error = greater(report_.backward_error, solved.backward_error);
  for (int k = 0; k < n; ++k) u_[points[k]] += (problem_.system.ends() ? 0.5 : 1) * u[k];
}

/// Computes the window's heat, scaled to a largest value of 1 per component.
/// @return the divisors by component
VectorXd HeatWindows::solve() {
  u_.setZero();
  by_factor_ = true;
  solveSystem(false);
  if (problem_.system.ends()) solveSystem(true);
  u_ = u_.cwiseMax(0);
  return problem_.components.normalise(u_);
}

/// Prepares the next round, which starts from the flow out of passed points into those ahead. Returns whether anything
/// flows.
bool HeatWindows::restart() {
  for (const int i : window_) {
    if (log_heat_[i] >= log_front_) {
      passed_[i] = 1;
      rim_.push_back(i);
    } else {
      log_heat_[i] = nothing;
    }
  }
  heat_.setZero();
  bool flows = false;
  std::size_t kept = 0;
  for (const int i : rim_) {
    bool on_rim = false;
    const double heat = std::exp(std::min(hottest, log_heat_[i] - log_front_));
    for (SparseMatrix::InnerIterator entry(problem_.L, i); entry; ++entry) {
      const auto j = entry.row();
      if (passed_[j] != 0 || problem_.components.of[j] != problem_.components.of[i]) continue;
      on_rim = true;
      heat_[j] -= entry.value() * heat;
      flows |= heat_[j] > 0;
    }
    if (on_rim) rim_[kept++] = i;
  }
  rim_.resize(kept);
  for (const int i : problem_.components.points)
    if (passed_[i] != 0) log_heat_[i] -= log_front_;
  return flows;
}

}  // namespace tufted
