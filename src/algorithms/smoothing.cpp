// Smoothing by implicit (backward Euler) steps of the heat equation.
#include "tufted/smoothing.h"

#include <algorithm>
#include <cmath>
#include <string>

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

void checkArguments(const Laplacian& laplacian, const PointsRef& points, const SmoothingOptions& options) {
  checkSizes("smooth", laplacian);
  const std::string name = "smooth: ";
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  const auto checkRows = [&](const char* what, Eigen::Index rows) {
    if (rows != n) {
      throw InvalidInput(name + what + " has " + std::to_string(rows) + " rows, must have " + std::to_string(n) +
                         ", one per point of the Laplacian");
    }
  };
  checkRows("points", points.rows());
  if (options.fixed != nullptr) checkRows("fixed", static_cast<Eigen::Index>(options.fixed->size()));
  if (!(options.time_step >= 0 && std::isfinite(options.time_step))) {
    throw InvalidInput(name + "time_step = " + numberText(options.time_step) + ", must be finite and at least 0");
  }
  if (options.iterations < 1) {
    throw InvalidInput(name + "iterations = " + std::to_string(options.iterations) + ", must be at least 1");
  }
  if (options.threads < 0) {
    throw InvalidInput(name + "threads = " + std::to_string(options.threads) + ", must be >= 0");
  }
  for (Eigen::Index i = 0; i < n; ++i) {
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

}  // namespace

Points smooth(const Laplacian& laplacian, const PointsRef& points, const SmoothingOptions& options) {
  checkArguments(laplacian, points, options);
  const Workers workers(options.threads, options.progress);
  const std::vector<bool> is_free = freePoints(laplacian, options.fixed);
  Points result = points;
  if (std::find(is_free.begin(), is_free.end(), true) == is_free.end() || options.time_step == 0) return result;

  workers.report("factor", 0);
  const SystemNames names = {.function = "smooth",
                             .matrix = "M + t L",
                             .if_slow = "take a smaller time_step",
                             .if_large = "take fewer points"};
  const LinearSystem system = LinearSystem::positiveDefinite(names, systemMatrix(laplacian, is_free, options.time_step),
                                                             {.threads = options.threads});

  // Solved for the way each point goes: x' = x + d with (M + t L) d = -t L x.
  Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(points.rows(), 3);
  for (int step = 0; step < options.iterations; ++step) {
    workers.report("smooth", static_cast<double>(step) / options.iterations);
    moved += system.solve("smooth", pull(laplacian, is_free, points, moved), nullptr, {});
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

}  // namespace tufted
