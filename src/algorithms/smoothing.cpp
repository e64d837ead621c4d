#include "tufted/smoothing.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/parallel.h"
#include "operators/lower_triangle.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// A mass below this part of its row of t L is lost when the two are added: raised to it, the matrix stays positive
/// definite and an M-matrix, so the maximum principle survives any step and any two components of unlike size.
constexpr double least_mass = 1e-13;

void checkArguments(const Laplacian& laplacian, const Points& points, const SmoothingOptions& options) {
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
    throw InvalidInput(name + "time_step = " + std::to_string(options.time_step) + ", must be finite and at least 0");
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

/// The points that move.
Selection freePoints(const Laplacian& laplacian, const std::vector<std::uint8_t>* fixed) {
  const int n = static_cast<int>(laplacian.status.size());
  Selection free(laplacian.status.size());
  std::vector<std::uint8_t> stays(laplacian.status.size(), 0);
  for (int i = 0; fixed != nullptr && i < n; ++i) stays[laplacian.representative[i]] |= (*fixed)[i];
  for (int i = 0; i < n; ++i) {
    if (laplacian.status[i] == PointStatus::active && stays[i] == 0) free.add(i);
  }
  return free;
}

/// Lower triangle of M / t + L over the free points, t with its unit.
LongMatrix systemMatrix(const Laplacian& laplacian, const Selection& free, double time_step) {
  const double unit = laplacian.report.mean_squared_edge;
  return lowerTriangle(laplacian.L, free, [&](int i, int j, double value) {
    if (i != j) return value;
    // Divided one by one, as the product may not fit a double. Where unit and mass both underflow, the least mass wins
    // over the NaN because it stands first.
    return value + std::max(least_mass * value, laplacian.M[i] / unit / time_step);
  });
}

/// -L (x + moved) of one coordinate at the free points. From differences of neighbours alone, as the rows of L sum to
/// 0, so distance from the origin costs no digits.
VectorXd pull(const Laplacian& laplacian, const Selection& free, const Points& points, const Points& moved, int axis) {
  VectorXd result(static_cast<Eigen::Index>(free.point.size()));
  for (Eigen::Index k = 0; k < result.size(); ++k) {
    const int i = free.point[k];
    double sum = 0;
    for (SparseMatrix::InnerIterator entry(laplacian.L, i); entry; ++entry) {
      const auto j = entry.row();
      if (j == i) continue;
      sum -= entry.value() * ((points(j, axis) - points(i, axis)) + (moved(j, axis) - moved(i, axis)));
    }
    result[k] = sum;
  }
  return result;
}

}  // namespace

Points smooth(const Laplacian& laplacian, const Points& points, const SmoothingOptions& options) {
  checkArguments(laplacian, points, options);
  const Workers workers(options.threads, options.progress);
  const Selection free = freePoints(laplacian, options.fixed);
  Points result = points;
  if (free.point.empty() || options.time_step == 0) return result;

  workers.report("factor", 0);
  const Eigen::SimplicialLDLT<LongMatrix> solver(systemMatrix(laplacian, free, options.time_step));
  if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 0)) {
    throw SolverFailure("smooth: M + t L of " + std::to_string(free.point.size()) +
                        " free points is not positive definite");
  }

  // Solved for the way each point goes: x' = x + d with (M + t L) d = -t L x.
  Points moved = Points::Zero(points.rows(), 3);
  const Progress silent;
  const Workers axes(options.threads, silent);  // steps are reported, not coordinates
  for (int step = 0; step < options.iterations; ++step) {
    workers.report("smooth", static_cast<double>(step) / options.iterations);
    axes.forBlocks("smooth", 3, 1, [&](std::int64_t begin, std::int64_t end, int) {
      for (int axis = static_cast<int>(begin); axis < end; ++axis) {
        const VectorXd way = solver.solve(pull(laplacian, free, points, moved, axis));
        for (std::size_t k = 0; k < free.point.size(); ++k) {
          moved(free.point[k], axis) += way[static_cast<Eigen::Index>(k)];
        }
      }
    });
  }
  for (const int i : free.point) result.row(i) += moved.row(i);
  for (std::size_t i = 0; i < laplacian.status.size(); ++i) {
    if (laplacian.status[i] != PointStatus::coincident) continue;
    result.row(static_cast<Eigen::Index>(i)) = result.row(laplacian.representative[i]);
  }
  workers.report("done", 1);
  return result;
}

}  // namespace tufted
