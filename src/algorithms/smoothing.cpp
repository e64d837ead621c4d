// Smoothing by implicit (backward Euler) steps of the heat equation.
#include "tufted/smoothing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "algorithms/linear_system.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// A mass below this part of its row of t L is lost when the two are added: raised to it, the matrix stays positive
/// definite and an M-matrix, so the maximum principle survives any step and any two components of unlike size.
constexpr double least_mass = 1e-13;

constexpr const char* smooth_name = "smooth";

void checkRows(const std::string& function, const Laplacian& laplacian, const char* what, Eigen::Index rows) {
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  if (rows == n) return;
  throw InvalidInput(function + ": " + what + " has " + std::to_string(rows) + " rows, must have " + std::to_string(n) +
                     ", one per point of the Laplacian");
}

void checkPoints(const Laplacian& laplacian, const PointsRef& points, int iterations) {
  const std::string name = std::string(smooth_name) + ": ";
  checkRows(smooth_name, laplacian, "points", points.rows());
  if (iterations < 1) throw InvalidInput(name + "iterations = " + std::to_string(iterations) + ", must be at least 1");
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (laplacian.status[i] == PointStatus::active && !points.row(i).allFinite()) {
      throw InvalidInput(name + "point " + std::to_string(i) + " is not finite, must be: the Laplacian has it active");
    }
  }
}

/// Whether a point moves.
std::vector<bool> freePoints(const Laplacian& laplacian, const std::vector<std::uint8_t>* fixed) {
  const int n = static_cast<int>(laplacian.status.size());
  std::vector<bool> is_free(laplacian.status.size());
  for (int i = 0; i < n; ++i) is_free[i] = laplacian.status[i] == PointStatus::active;
  for (int i = 0; fixed != nullptr && i < n; ++i)
    if ((*fixed)[i] != 0) is_free[laplacian.representative[i]] = false;
  return is_free;
}

/// The lower triangle of M / t + L over the free points, t with its unit; rows of all others are empty.
SparseMatrix systemMatrix(const Laplacian& laplacian, const std::vector<bool>& is_free, double time_step) {
  const double unit = laplacian.report.mean_squared_edge;
  const SparseMatrix& L = laplacian.L;
  SparseMatrix lower(L.rows(), L.cols());
  lower.reserve(L.nonZeros() / 2 + L.cols());
  for (int j = 0; j < L.cols(); ++j) {
    lower.startVec(j);
    for (SparseMatrix::InnerIterator entry(L, j); entry; ++entry) {
      const int i = static_cast<int>(entry.row());
      if (i < j || !is_free[i] || !is_free[j]) continue;
      // Divided one by one, as the product may not fit a double. Where unit and mass both underflow, the least mass
      // wins over the NaN because it stands first.
      const double mass = i == j ? std::max(least_mass * entry.value(), laplacian.M[i] / unit / time_step) : 0;
      lower.insertBack(i, j) = entry.value() + mass;
    }
  }
  lower.finalize();
  return lower;
}

/// The right side -L (x + moved) at the free points. It comes from differences of neighbours alone, as the rows of L
/// sum to 0, so distance from the origin costs no digits.
Eigen::MatrixXd pull(const Laplacian& laplacian, const std::vector<bool>& is_free, const PointsRef& points,
                     const Eigen::MatrixXd& moved) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(points.rows(), 3);
  for (int i = 0; i < points.rows(); ++i) {
    if (!is_free[i]) continue;
    for (SparseMatrix::InnerIterator entry(laplacian.L, i); entry; ++entry) {
      const auto j = entry.row();
      if (j != i) result.row(i) -= entry.value() * ((points.row(j) - points.row(i)) + (moved.row(j) - moved.row(i)));
    }
  }
  return result;
}

/// The matrix of one step, factored.
struct Step {
  std::vector<bool> is_free;
  std::optional<LinearSystem> system;  ///< none: nothing moves
  SolverReport report;

  /// @param function to be named in errors
  Step(const std::string& function, const Laplacian& laplacian, double time_step,
       const std::vector<std::uint8_t>* fixed, const SolverOptions& options) {
    checkSizes(function, laplacian);
    if (fixed != nullptr) checkRows(function, laplacian, "fixed", static_cast<Eigen::Index>(fixed->size()));
    if (!(time_step >= 0 && std::isfinite(time_step))) {
      throw InvalidInput(function + ": time_step = " + numberText(time_step) + ", must be finite and at least 0");
    }
    if (options.threads < 0)
      throw InvalidInput(function + ": threads = " + std::to_string(options.threads) + ", must be >= 0");
    is_free = freePoints(laplacian, fixed);
    if (time_step == 0 || std::find(is_free.begin(), is_free.end(), true) == is_free.end()) return;
    const SystemNames names = {.function = function,
                               .matrix = "M + t L",
                               .if_slow = "take a smaller time_step",
                               .if_large = "take fewer points"};
    system.emplace(LinearSystem::positiveDefinite(names, systemMatrix(laplacian, is_free, time_step), options));
    report = system->report();
  }

  Points smooth(const Laplacian& laplacian, const PointsRef& points, int iterations, const Progress& progress) const {
    Points result = points;
    if (!system) return result;
    const Workers workers(1, progress);
    // Solved for the way each point goes: x' = x + d with (M + t L) d = -t L x.
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(points.rows(), 3);
    for (int step = 0; step < iterations; ++step) {
      const auto before = static_cast<double>(step);
      workers.report("smooth", before / iterations);
      const Progress within = [&](std::string_view, double fraction) {
        return progress == nullptr || progress("smooth", (before + fraction) / iterations);
      };
      moved += system->solve(smooth_name, pull(laplacian, is_free, points, moved), nullptr, within);
    }
    for (int i = 0; i < points.rows(); ++i)
      if (is_free[i]) result.row(i) += moved.row(i);
    for (std::size_t i = 0; i < laplacian.status.size(); ++i) {
      if (laplacian.status[i] != PointStatus::coincident) continue;
      result.row(static_cast<Eigen::Index>(i)) = result.row(laplacian.representative[i]);
    }
    workers.report("done", 1);
    return result;
  }
};

}  // namespace

Points smooth(const Laplacian& laplacian, const PointsRef& points, const SmoothingOptions& options) {
  checkSizes(smooth_name, laplacian);
  checkPoints(laplacian, points, options.iterations);
  const Step step(smooth_name, laplacian, options.time_step, options.fixed,
                  {.threads = options.threads, .progress = options.progress});
  return step.smooth(laplacian, points, options.iterations, options.progress);
}

struct SmoothingSolver::State {
  std::shared_ptr<const Laplacian> laplacian;
  Step step;
};

SmoothingSolver::SmoothingSolver(std::shared_ptr<const Laplacian> laplacian, double time_step,
                                 const std::vector<std::uint8_t>* fixed, const SolverOptions& options) {
  constexpr const char* function = "SmoothingSolver";
  if (laplacian == nullptr) throw InvalidInput(std::string(function) + ": laplacian is null, must not be");
  Step step(function, *laplacian, time_step, fixed, options);
  state_ = std::make_unique<const State>(State{std::move(laplacian), std::move(step)});
}

Points SmoothingSolver::smooth(const PointsRef& points, int iterations, const Progress& progress) const {
  checkPoints(*state_->laplacian, points, iterations);
  return state_->step.smooth(*state_->laplacian, points, iterations, progress);
}

const SolverReport& SmoothingSolver::report() const {
  return state_->step.report;
}

SmoothingSolver::SmoothingSolver(SmoothingSolver&&) noexcept = default;
SmoothingSolver& SmoothingSolver::operator=(SmoothingSolver&&) noexcept = default;
SmoothingSolver::~SmoothingSolver() = default;

}  // namespace tufted
