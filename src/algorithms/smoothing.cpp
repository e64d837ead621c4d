// Smoothing by implicit (backward Euler) steps of the heat equation, or after Taubin (1995).
#include "tufted/smoothing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "algorithms/coincident.h"
#include "algorithms/enclosed_volume.h"
#include "algorithms/kept_laplacian.h"
#include "algorithms/linear_system.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/require.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// Longest time step. It moves all points of a mesh of 642 to their centre of mass up to 1e-9; from 1e13 on masses are
/// lost, and they move elsewhere.
constexpr double longest_step = 1e10;

constexpr const char* smooth_name = "smooth";

void checkRows(const std::string& function, const Laplacian& laplacian, const char* what, Eigen::Index rows) {
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  if (rows == n) return;
  throw InvalidInput(function + ": " + what + " has " + std::to_string(rows) + " rows, must have " + std::to_string(n) +
                     ", one per point of the Laplacian");
}

/// @param what "points" or "values"
void checkValues(const std::string& function, const Laplacian& laplacian, const char* what,
                 const Eigen::MatrixXd& values, int iterations) {
  const std::string name = function + ": ";
  checkRows(function, laplacian, what, values.rows());
  if (iterations < 1) throw InvalidInput(name + "iterations = " + std::to_string(iterations) + ", must be at least 1");
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    if (laplacian.status[i] == PointStatus::active && !values.row(i).allFinite()) {
      throw InvalidInput(name + "point " + std::to_string(i) + " is not finite, must be: the Laplacian has it active");
    }
  }
}

void checkFixed(const std::string& function, const Laplacian& laplacian, const std::vector<std::uint8_t>* fixed) {
  if (fixed != nullptr) checkRows(function, laplacian, "fixed", static_cast<Eigen::Index>(fixed->size()));
}

void checkThreads(const std::string& function, int threads) {
  if (threads < 0) throw InvalidInput(function + ": threads = " + std::to_string(threads) + ", must be >= 0");
}

/// Whether each point may move.
std::vector<bool> freePoints(const Laplacian& laplacian, const std::vector<std::uint8_t>* fixed) {
  const int n = static_cast<int>(laplacian.status.size());
  std::vector<bool> is_free(laplacian.status.size());
  for (int i = 0; i < n; ++i) is_free[i] = laplacian.status[i] == PointStatus::active;
  for (int i = 0; fixed != nullptr && i < n; ++i)
    if ((*fixed)[i] != 0) is_free[laplacian.representative[i]] = false;
  return is_free;
}

/// The lower triangle of M / t + L over the free points, with t in the unit of each component; rows of other points are
/// empty.
SparseMatrix systemMatrix(const std::string& function, const Laplacian& laplacian, const std::vector<bool>& is_free,
                          double time_step) {
  const std::vector<ComponentEdges>& edges = laplacian.component_edges;
  const std::vector<int>& component = laplacian.component;
  const SparseMatrix& L = laplacian.L;
  SparseMatrix lower(L.rows(), L.cols());
  lower.reserve(L.nonZeros() / 2 + L.cols());
  for (int j = 0; j < L.cols(); ++j) {
    lower.startVec(j);
    if (is_free[j] && (component.empty() || component[j] < 0 || component[j] >= std::ssize(edges)))
      throw InvalidInput(function + ": component_edges has " + std::to_string(edges.size()) +
                         " entries and none for point " + std::to_string(j) +
                         ", must have one for its component: the unit of the time step");
    for (SparseMatrix::InnerIterator entry(L, j); entry; ++entry) {
      const int i = static_cast<int>(entry.row());
      if (i < j || !is_free[i] || !is_free[j]) continue;
      // Divided one by one, as the product may overflow. If unit and mass are both 0, std::max returns its first
      // argument, not the NaN.
      const double mass =
          i == j ? std::max(least_mass * entry.value(), laplacian.M[i] / edges[component[i]].mean_square / time_step)
                 : 0;
      lower.insertBack(i, j) = entry.value() + mass;
    }
  }
  lower.finalize();
  return lower;
}

/// The right side -L (x + moved) at the free points, from differences of neighbours, so that distance from the origin
/// costs no digits.
Eigen::MatrixXd pull(const Laplacian& laplacian, const std::vector<bool>& is_free, const Eigen::MatrixXd& points,
                     const Eigen::MatrixXd& moved) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(points.rows(), points.cols());
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
struct FactoredStep {
  std::vector<bool> is_free;
  std::optional<LinearSystem> system;  ///< not set if nothing moves
  SolverReport report;

  /// @param function named in errors
  FactoredStep(const std::string& function, const Laplacian& laplacian, const SmoothingOptions& options) {
    const double time_step = options.time_step;
    checkSizes(function, laplacian);
    checkFixed(function, laplacian, options.fixed);
    if (!(time_step >= 0 && std::isfinite(time_step))) {
      throw InvalidInput(function + ": time_step = " + numberText(time_step) + ", must be finite and at least 0");
    }
    if (time_step > longest_step)
      throw InvalidInput(function + ": time_step = " + numberText(time_step) + ", must be at most " +
                         numberText(longest_step));
    checkThreads(function, options.solver.threads);
    is_free = freePoints(laplacian, options.fixed);
    if (time_step == 0 || std::find(is_free.begin(), is_free.end(), true) == is_free.end()) return;
    const SystemNames names = {.function = function,
                               .matrix = "M + t L",
                               .if_slow = "take a smaller time_step",
                               .if_large = "take fewer points"};
    system.emplace(
        LinearSystem::positiveDefinite(names, systemMatrix(function, laplacian, is_free, time_step), options.solver));
    report = system->report();
  }

  /// @param points N x c
  Eigen::MatrixXd smooth(const std::string& function, const Laplacian& laplacian, const Eigen::MatrixXd& points,
                         int iterations, const Progress& progress) const {
    Eigen::MatrixXd result = points;
    if (!system) return result;
    const Workers workers(1, progress);
    // Solves for displacements: x' = x + d with (M + t L) d = -t L x.
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(points.rows(), points.cols());
    for (int step = 0; step < iterations; ++step) {
      const auto before = static_cast<double>(step);
      workers.report("smooth", before / iterations);
      const Progress within = [&](std::string_view, double fraction) {
        return progress == nullptr || progress("smooth", (before + fraction) / iterations);
      };
      moved += system->solve(function, pull(laplacian, is_free, points, moved), nullptr, within);
    }
    for (int i = 0; i < points.rows(); ++i)
      if (is_free[i]) result.row(i) += moved.row(i);
    copyToCoincident(laplacian, result);
    workers.report("done", 1);
    return result;
  }
};

/// A step of Taubin's towards the means of neighbours, or away from them: x -= share D^-1 L x at the free points.
void stepToMeans(const Laplacian& laplacian, const std::vector<bool>& is_free, double share, const Workers& workers,
                 Eigen::MatrixXd& x) {
  const Eigen::MatrixXd old = x;
  workers.forBlocks("smooth", x.rows(), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    Eigen::RowVectorXd pulled(x.cols());
    for (auto i = static_cast<int>(begin); i < end; ++i) {
      if (!is_free[i]) continue;
      double sum = 0;
      pulled.setZero();
      for (SparseMatrix::InnerIterator entry(laplacian.L, i); entry; ++entry) {
        const auto j = entry.row();
        if (j == i) continue;
        sum -= entry.value();
        pulled -= entry.value() * (old.row(j) - old.row(i));
      }
      if (sum > 0) x.row(i) += share / sum * pulled;
    }
  });
}

Eigen::MatrixXd smoothByTaubin(const std::string& function, const Laplacian& laplacian, const Eigen::MatrixXd& points,
                               const SmoothingOptions& options) {
  const auto [lambda, mu] = std::pair(options.lambda, options.mu);
  if (!(lambda > 0 && lambda <= 1))
    throw InvalidInput(function + ": lambda = " + numberText(lambda) + ", must lie in (0, 1]");
  if (!(mu >= -1 && mu <= 0)) throw InvalidInput(function + ": mu = " + numberText(mu) + ", must lie in [-1, 0]");
  if (!((1 - 2 * lambda) * (1 - 2 * mu) >= -1))
    throw InvalidInput(function + ": lambda = " + numberText(lambda) + " and mu = " + numberText(mu) +
                       ", must have (1 - 2 lambda) (1 - 2 mu) >= -1, or short waves grow");
  checkThreads(function, options.solver.threads);
  const Workers workers(options.solver.threads, options.solver.progress);
  const std::vector<bool> is_free = freePoints(laplacian, options.fixed);
  Eigen::MatrixXd x = points;
  for (int step = 0; step < options.iterations; ++step) {
    stepToMeans(laplacian, is_free, lambda, workers, x);
    if (mu != 0) stepToMeans(laplacian, is_free, mu, workers, x);
  }
  copyToCoincident(laplacian, x);
  return x;
}

/// @param what "points" or "values"
Eigen::MatrixXd smoothed(const std::string& function, const Laplacian& laplacian, const char* what,
                         const Eigen::MatrixXd& values, const SmoothingOptions& options) {
  checkSizes(function, laplacian);
  checkValues(function, laplacian, what, values, options.iterations);
  checkFixed(function, laplacian, options.fixed);
  requireChoice(options.method, SmoothingMethod::taubin, function, "method");
  if (options.method == SmoothingMethod::taubin) return smoothByTaubin(function, laplacian, values, options);
  const FactoredStep step(function, laplacian, options);
  return step.smooth(function, laplacian, values, options.iterations, options.solver.progress);
}

}  // namespace

Points smooth(const Laplacian& laplacian, const PointsRef& points, const SmoothingOptions& options) {
  std::optional<EnclosedVolume> volume;
  if (options.volume_of != nullptr) {
    if (options.fixed != nullptr)
      throw InvalidInput(std::string(smooth_name) + ": volume_of and fixed are given, must be one of both");
    checkSizes(smooth_name, laplacian);
    checkValues(smooth_name, laplacian, "points", points, options.iterations);
    volume.emplace(smooth_name, laplacian, *options.volume_of, points);
  }
  Eigen::MatrixXd x = smoothed(smooth_name, laplacian, "points", points, options);
  if (volume) {
    volume->restore(x);
    copyToCoincident(laplacian, x);
  }
  return x;
}

Eigen::MatrixXd smoothValues(const Laplacian& laplacian, const Eigen::MatrixXd& values,
                             const SmoothingOptions& options) {
  constexpr const char* function = "smoothValues";
  if (options.volume_of != nullptr)
    throw InvalidInput(std::string(function) + ": volume_of is given, must be with positions alone");
  return smoothed(function, laplacian, "values", values, options);
}

struct SmoothingSolver::State {
  Laplacian laplacian;
  FactoredStep step;
};

SmoothingSolver::SmoothingSolver(const Laplacian& laplacian, const SmoothingOptions& options) {
  const std::string function = "SmoothingSolver";
  if (options.method != SmoothingMethod::implicit)
    throw InvalidInput(function + ": method = taubin, must be implicit: there is nothing to factorise");
  if (options.volume_of != nullptr) throw InvalidInput(function + ": volume_of is given, must not be");
  FactoredStep step(function, laplacian, options);
  state_ = std::make_unique<const State>(State{keptLaplacian(laplacian), std::move(step)});
}

Points SmoothingSolver::query(const PointsRef& points, int iterations, const Progress& progress) const {
  const Eigen::MatrixXd values = points;
  checkValues(smooth_name, state_->laplacian, "points", values, iterations);
  return state_->step.smooth(smooth_name, state_->laplacian, values, iterations, progress);
}

const SolverReport& SmoothingSolver::report() const {
  return state_->step.report;
}

}  // namespace tufted
