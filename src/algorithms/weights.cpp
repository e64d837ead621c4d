// Bounded biharmonic weights (Jacobson, Baran, Popovic, Sorkine 2011).
#include "tufted/weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "algorithms/bounded_problem.h"
#include "algorithms/coincident.h"
#include "algorithms/connected.h"
#include "base/parallel.h"
#include "base/require.h"
#include "base/stage_clock.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* weights_name = "boundedBiharmonicWeights";

/// The handle of each active point, N; -1: none.
std::vector<int> handlesOfPoints(const Laplacian& laplacian, const Components& components,
                                 const std::vector<std::vector<int>>& handles) {
  const auto n = static_cast<int>(laplacian.status.size());
  if (handles.empty()) refuse(weights_name, "handles is empty, must name at least one");
  std::vector<int> of(laplacian.status.size(), -1);
  for (std::size_t h = 0; h < handles.size(); ++h) {
    bool has_active = false;
    for (const int point : handles[h]) {
      if (point < 0 || point >= n)
        refuse(weights_name, "handle " + std::to_string(h) + " has point " + std::to_string(point) +
                                 ", must lie in [0, " + std::to_string(n) + ")");
      const int i = laplacian.representative[point];
      if (components.of[i] < 0) continue;
      has_active = true;
      if (of[i] >= 0 && of[i] != static_cast<int>(h))
        refuse(weights_name, "point " + std::to_string(point) + " is of handle " + std::to_string(of[i]) +
                                 " and of handle " + std::to_string(h) + ", must be of one");
      of[i] = static_cast<int>(h);
    }
    if (has_active) continue;
    std::string why;
    if (!handles[h].empty())
      why = ": " + whyOnNone("point", handles[h][0], laplacian.status[laplacian.representative[handles[h][0]]]);
    refuse(weights_name, "handle " + std::to_string(h) + " has no active point, must have at least one" + why);
  }
  return of;
}

/// Number of free points with a value above that of all neighbours.
std::int64_t localMaxima(const Laplacian& laplacian, const std::vector<std::uint8_t>& is_free, const VectorXd& u) {
  std::int64_t count = 0;
  for (int i = 0; i < u.size(); ++i) {
    if (is_free[i] == 0 || !(u[i] > BoundedProblem::allowed)) continue;
    bool is_highest = true;
    for (SparseMatrix::InnerIterator entry(laplacian.L, i); entry && is_highest; ++entry)
      is_highest = entry.row() == i || u[entry.row()] < u[i] - BoundedProblem::allowed;
    count += is_highest ? 1 : 0;
  }
  return count;
}

}  // namespace

Eigen::MatrixXd boundedBiharmonicWeights(const Laplacian& laplacian, const std::vector<std::vector<int>>& handles,
                                         const WeightOptions& options, WeightReport* report) {
  const Stopwatch watch;
  checkSizes(weights_name, laplacian);
  if (options.max_iterations < 1)
    refuse(weights_name, "max_iterations = " + std::to_string(options.max_iterations) + ", must be at least 1");
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
    if (has_handle[components.of[i]] != 0 && handle[i] < 0) is_free[i] = 1, ++made.free;
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
    // On components without this handle the weight is 0.
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
      throw SolverFailure(std::string(weights_name) + ": all weights of point " + std::to_string(i) +
                          " are 0, add a handle near it");
    weights.row(i) /= sum;
  }
  copyToCoincident(laplacian, weights);
  made.not_reached = weights.col(0).array().isNaN().count();
  workers.report("done", 1);
  made.seconds = watch.seconds();
  if (report != nullptr) *report = made;
  return weights;
}

}  // namespace tufted
