// Conformalised mean curvature flow (Kazhdan, Solomon, Ben-Chen 2012).
#include "tufted/mean_curvature_flow.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/check_positions.h"
#include "algorithms/coincident.h"
#include "algorithms/connected.h"
#include "algorithms/linear_system.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/power_of_two.h"
#include "base/require.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;

constexpr const char* flow_name = "meanCurvatureFlow";

/// Masses below this part of the mean one are raised to it: points of collapsed triangles have none.
constexpr double least_share = 1e-12;

/// Shortest time step: areas over shorter ones overflow.
constexpr double least_step = 1e-200;

class Flow {
 public:
  /// Scales each component about its middle to the area 1.
  Flow(const Laplacian& laplacian, const TrianglesRef& triangles)
      : L_(laplacian.L), components_(findComponents(laplacian)), x_(laplacian.positions) {
    double farthest = 0;
    for (const int i : components_.points) farthest = std::max(farthest, x_.row(i).cwiseAbs().maxCoeff());
    if (farthest > 0) exponent_ = std::ilogb(farthest) + 1;
    const PowerOfTwo unit(-exponent_);
    for (const int i : components_.points)
      for (double& value : x_.row(i)) value = unit.times(value);
    for (Index t = 0; t < triangles.rows(); ++t) {
      Eigen::RowVector3i corners = triangles.row(t);
      for (int& corner : corners) corner = laplacian.representative[corner];
      if (std::all_of(corners.begin(), corners.end(), [&](int i) { return components_.of[i] >= 0; }))
        triangles_.push_back(corners);
    }
    masses_ = lumpedAreas();
    const VectorXd areas = components_.sums(masses_);
    for (const int i : components_.points)
      if (areas[components_.of[i]] > 0) moving_.push_back(i);
    start_ = center();
  }

  void run(const MeanCurvatureFlowOptions& options) {
    if (moving_.empty()) return;
    const SystemNames names = {.function = flow_name,
                               .matrix = "M + t L",
                               .if_slow = "take a smaller time_step",
                               .if_large = "take fewer points"};
    const VectorXd degrees = L_.diagonal();
    const Workers workers(1, options.solver.progress);
    std::optional<LinearSystem> system;
    for (int step = 0; step < options.steps; ++step) {
      const double before = step;
      workers.report("flow", before / options.steps);
      const Progress within = [&](std::string_view, double fraction) {
        return !options.solver.progress || options.solver.progress("flow", (before + fraction) / options.steps);
      };
      const VectorXd masses = massesOver(options.time_step, degrees), diagonal = masses + degrees;
      // Only the diagonal changes, so that a factor needs the order of the unknowns once.
      if (system && !system->report().iterative)
        system->setDiagonal(diagonal);
      else
        system.emplace(LinearSystem::positiveDefinite(names, matrixWith(diagonal), options.solver));
      const Eigen::MatrixXd right = masses.asDiagonal() * x_;
      const Eigen::MatrixXd found = system->solve(flow_name, right, nullptr, within);
      for (const int i : moving_) x_.row(i) = found.row(i);
      masses_ = lumpedAreas();
      // A component whose area of 1 shrinks to the rounding of doubles has lost half of the digits of its coordinates.
      const VectorXd areas = components_.sums(masses_);
      for (const int i : moving_)
        if (!(areas[components_.of[i]] > std::numeric_limits<double>::epsilon()))
          throw SolverFailure(std::string(flow_name) + ": a step leaves the component of point " + std::to_string(i) +
                              " without area; time_step = " + numberText(options.time_step) + " is too large");
      center();
    }
    workers.report("done", 1);
  }

  /// Sets the rows of the points that move to where they are.
  void place(Points& points) const {
    const PowerOfTwo unit(exponent_);
    for (const int i : moving_) {
      const int c = components_.of[i];
      for (int k = 0; k < 3; ++k) points(i, k) = unit.times(x_(i, k) * start_.size[c] + start_.middle[c][k]);
    }
  }

 private:
  /// The middles of all components and the roots of their areas.
  struct Placement {
    std::vector<RowVector3d> middle;
    std::vector<double> size;
  };

  /// A third of the area of each triangle at each of its corners.
  VectorXd lumpedAreas() const {
    VectorXd masses = VectorXd::Zero(x_.rows());
    for (const Eigen::RowVector3i& corners : triangles_) {
      const RowVector3d a = x_.row(corners[0]), b = x_.row(corners[1]), c = x_.row(corners[2]);
      const double third = (b - a).cross(c - a).norm() / 6;
      for (const int i : corners) masses[i] += third;
    }
    return masses;
  }

  /// Moves the middle of each component that moves to 0 and scales its area to 1. Returns where it was.
  Placement center() {
    const VectorXd areas = components_.sums(masses_);
    const auto count = static_cast<std::size_t>(components_.count);
    Placement before = {std::vector<RowVector3d>(count, RowVector3d::Zero()), std::vector<double>(count)};
    for (const int i : moving_) before.middle[components_.of[i]] += masses_[i] * x_.row(i);
    for (int c = 0; c < components_.count; ++c) {
      if (!(areas[c] > 0)) continue;
      before.middle[c] /= areas[c];
      before.size[c] = std::sqrt(areas[c]);
    }
    for (const int i : moving_) {
      const int c = components_.of[i];
      x_.row(i) = (x_.row(i) - before.middle[c]) / before.size[c];
      masses_[i] /= areas[c];
    }
    return before;
  }

  /// M / t, where no mass is lost beside its diagonal in L.
  VectorXd massesOver(double time_step, const VectorXd& degrees) const {
    double mean = 0;
    for (const int i : moving_) mean += masses_[i] / static_cast<double>(moving_.size());
    VectorXd masses = VectorXd::Zero(x_.rows());
    for (const int i : moving_)
      masses[i] = std::max(least_mass * degrees[i], std::max(masses_[i], least_share * mean) / time_step);
    return masses;
  }

  /// The lower triangle of L with another diagonal, over the points that move.
  SparseMatrix matrixWith(const VectorXd& diagonal) const {
    std::vector<bool> moves(static_cast<std::size_t>(L_.rows()));
    for (const int i : moving_) moves[i] = true;
    std::vector<Eigen::Triplet<double>> entries;
    for (const int j : moving_) {
      entries.emplace_back(j, j, diagonal[j]);
      for (SparseMatrix::InnerIterator entry(L_, j); entry; ++entry)
        if (entry.row() > j && moves[entry.row()]) entries.emplace_back(entry.row(), j, entry.value());
    }
    SparseMatrix lower(L_.rows(), L_.cols());
    lower.setFromTriplets(entries.begin(), entries.end());
    return lower;
  }

  const SparseMatrix& L_;
  const Components components_;
  std::vector<Eigen::RowVector3i> triangles_;
  std::vector<int> moving_;  ///< points of components with an area
  Points x_;
  int exponent_ = 0;  ///< of the unit of `start_`, in which no coordinate exceeds 1
  VectorXd masses_;
  Placement start_;  ///< before the first step
};

}  // namespace

Points meanCurvatureFlow(const Laplacian& laplacian, const TrianglesRef& triangles,
                         const MeanCurvatureFlowOptions& options) {
  checkPositions(flow_name, laplacian);
  if (options.steps < 1) refuse(flow_name, "steps = " + std::to_string(options.steps) + ", must be at least 1");
  if (!(options.time_step >= least_step && options.time_step <= 1 / least_step))
    refuse(flow_name, "time_step = " + numberText(options.time_step) + ", must lie in [1e-200, 1e200]");
  const auto n = std::ssize(laplacian.status);
  for (Index t = 0; t < triangles.rows(); ++t)
    for (const int corner : triangles.row(t))
      if (corner < 0 || corner >= n)
        refuse(flow_name, "triangle " + std::to_string(t) + " has the corner " + std::to_string(corner) +
                              ", must lie in [0, " + std::to_string(n) + ")");
  Flow flow(laplacian, triangles);
  flow.run(options);
  Points moved = laplacian.positions;
  flow.place(moved);
  copyToCoincident(laplacian, moved);
  return moved;
}

}  // namespace tufted
