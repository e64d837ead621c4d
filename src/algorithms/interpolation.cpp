// Harmonic and biharmonic interpolation, Poisson equations and Green's functions (Sharp and Crane 2020, Section 5.5 and
// Figure 19).
#include "tufted/interpolation.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/bending.h"
#include "algorithms/coincident.h"
#include "algorithms/connected.h"
#include "algorithms/kept_laplacian.h"
#include "algorithms/linear_system.h"
#include "algorithms/nearly_disconnected.h"
#include "algorithms/pinned_solver.h"
#include "algorithms/pinned_system.h"
#include "algorithms/refinement.h"
#include "base/require.h"
#include "base/stage_clock.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// The last correction must be at most this part of the range of values: the first for harmonic(), the second for
/// biharmonic(), whose matrix has the squared condition number.
constexpr double promised = 1e-12, promised_of_bending = 1e-3;

Eigen::MatrixXd finish(const Laplacian& laplacian, Eigen::MatrixXd u, const Stopwatch& watch, SolveReport made,
                       SolveReport* report) {
  copyToCoincident(laplacian, u);  // coincident pins get the mean of their values
  if (!(made.residual <= large_residual)) made.weak_joint = weakestJoint(laplacian.L);
  made.seconds = watch.seconds();
  if (report != nullptr) *report = made;
  return u;
}

/// The product M f, with 0 at points that are not active.
Eigen::MatrixXd weighted(const Laplacian& laplacian, const Eigen::MatrixXd& f) {
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(f.rows(), f.cols());
  for (Eigen::Index i = 0; i < f.rows(); ++i) {
    if (laplacian.status[i] == PointStatus::active) b.row(i) = laplacian.M[i] * f.row(i);
  }
  return b;
}

/// Advice for errors. It does not mention the tolerance, as corrections make solves exact with any.
constexpr const char* if_slow = "raise max_iterations, or set method to SolverMethod::cholesky";

/// The factored system of harmonic or biharmonic functions for one set of pinned points.
class Interpolator {
 public:
  /// @param function named in errors
  Interpolator(const std::string& function, const Laplacian& laplacian, std::vector<int> points, Interpolation kind,
               const SolverOptions& options)
      : kind_(kind), points_(std::move(points)) {
    requireChoice(kind, Interpolation::biharmonic, function, "kind");
    PinnedPoints pinned = pinnedPoints(function, laplacian, points_);
    if (kind == Interpolation::harmonic) {
      const SystemNames names = {.function = function, .matrix = "L", .if_slow = if_slow};
      solver_.emplace(names, std::move(pinned), laplacian.L, &laplacian, options);
      return;
    }
    const SystemNames names = {.function = function,
                               .matrix = "L M^-1 L",
                               .if_large = "take fewer points",
                               .if_too_large = IfTooLarge::refuse};
    inverse_ = inverseMasses(laplacian, pinned.components);
    bending_ = bendingMatrix(laplacian.L, inverse_);
    solver_.emplace(names, std::move(pinned), bending_, nullptr, options);
  }

  /// Solves with given values at the pins.
  /// @param b N x c
  /// @param watch started before the system was made or, if it is reused, before the solve
  /// @param iterations those of making the system, added to the report
  Eigen::MatrixXd solve(const std::string& function, const Laplacian& laplacian, const Eigen::MatrixXd& values,
                        const Eigen::MatrixXd& b, const Stopwatch& watch, int iterations, const Progress& progress,
                        SolveReport* report) const {
    const SparseMatrix& L = laplacian.L;
    const bool is_harmonic = kind_ == Interpolation::harmonic;
    const Missing of_harmonic = [&](const Eigen::MatrixXd& u, int i) -> Eigen::RowVectorXd {
      return b.row(i) - rowOfDifferences(L, u, i);
    };
    const Missing of_biharmonic = [&](const Eigen::MatrixXd& u, int i) {
      Eigen::RowVectorXd sum = b.row(i);
      for (SparseMatrix::InnerIterator entry(L, i); entry; ++entry) {
        const int j = static_cast<int>(entry.row());
        sum -= entry.value() * inverse_[j] * rowOfDifferences(L, u, j);
      }
      return sum;
    };
    const PinnedValues given = pinnedValues(laplacian, solver_->pinned(), points_, values);
    Refinement refinement(function, *solver_, given, is_harmonic ? of_harmonic : of_biharmonic, b,
                          is_harmonic ? promised : promised_of_bending);
    SolveReport made;
    made.iterations = iterations;
    Eigen::MatrixXd u = refinement.run(is_harmonic ? L : bending_, progress, made);
    return finish(laplacian, std::move(u), watch, made, report);
  }

  /// The right side for which M^-1 L u is as near to f as possible, in the norm of M; for harmonic functions M f.
  /// @param f N x c
  Eigen::MatrixXd rightOf(const Laplacian& laplacian, const Eigen::MatrixXd& f) const {
    Eigen::MatrixXd b = weighted(laplacian, f);
    if (kind_ == Interpolation::harmonic) return b;
    for (Eigen::Index i = 0; i < b.rows(); ++i) b.row(i) *= inverse_[i];
    return laplacian.L * b;
  }

  Interpolation kind() const { return kind_; }
  const std::vector<int>& points() const { return points_; }
  const PinnedSolver& solver() const { return *solver_; }

 private:
  Interpolation kind_;
  std::vector<int> points_;
  VectorXd inverse_;      ///< for biharmonic functions: see inverseMasses()
  SparseMatrix bending_;  ///< for biharmonic functions: L M^-1 L
  std::optional<PinnedSolver> solver_;
};

Eigen::MatrixXd noRight(const Laplacian& laplacian, Eigen::Index columns) {
  return Eigen::MatrixXd::Zero(laplacian.L.rows(), columns);
}

/// Makes a system, solves once, and discards it.
Eigen::MatrixXd solveOnce(const std::string& function, const Laplacian& laplacian, const Pins& pins,
                          const Eigen::MatrixXd& b, Interpolation kind, const SolverOptions& options,
                          SolveReport* report) {
  const Stopwatch watch;
  checkPinnedValues(function, pins.points, pins.values);
  const Interpolator made(function, laplacian, pins.points, kind, options);
  return made.solve(function, laplacian, pins.values, b, watch, made.solver().iterations(), options.progress, report);
}

void checkRows(const std::string& function, const Laplacian& laplacian, const Eigen::MatrixXd& f) {
  const std::size_t n = laplacian.status.size();
  if (static_cast<std::size_t>(f.rows()) == n) return;
  throw InvalidInput(function + " has " + std::to_string(f.rows()) + " rows, must have " + std::to_string(n) +
                     ", one per point of the Laplacian");
}

void checkRight(const std::string& function, const Laplacian& laplacian, const Eigen::MatrixXd& f) {
  checkSizes(function, laplacian);
  checkRows(function + ": f", laplacian, f);
  for (Eigen::Index i = 0; i < f.rows(); ++i) {
    if (laplacian.status[i] == PointStatus::active && !f.row(i).allFinite()) {
      throw InvalidInput(function + ": f of point " + std::to_string(i) + " is not finite, must be");
    }
  }
}

void checkColumns(const Eigen::MatrixXd& f, const Eigen::MatrixXd& values) {
  if (f.cols() == values.cols()) return;
  throw InvalidInput("poisson: f has " + std::to_string(f.cols()) + " columns, must have " +
                     std::to_string(values.cols()) + ", as pins.values");
}

LinearSystem systemOf(const std::string& function, const Laplacian& laplacian, const SolverOptions& options) {
  return LinearSystem::laplacian({.function = function, .matrix = "L"}, laplacian, options);
}

/// Solves L u = b with mean 0 by M on each component; NaN at points that are not active.
/// @param watch started before the system was made or, if it is reused, before the solve
Eigen::MatrixXd solveBalanced(const std::string& function, const Laplacian& laplacian, const LinearSystem& system,
                              const Eigen::MatrixXd& b, const Stopwatch& watch, const Progress& progress,
                              SolveReport* report) {
  SolveReport made;
  Eigen::MatrixXd u = system.solve(function, b, &made, progress, Refine::always);
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    if (laplacian.status[i] != PointStatus::active) u.row(i).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return finish(laplacian, std::move(u), watch, made, report);
}

/// The right sides of Green's functions, N x points: 1 at each point, which must be active.
Eigen::MatrixXd unitSources(const std::string& function, const Laplacian& laplacian, const std::vector<int>& points) {
  const int n = static_cast<int>(laplacian.status.size());
  if (points.empty()) throw InvalidInput(function + ": points is empty, must name at least one");
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k] < 0 || points[k] >= n) {
      throw InvalidInput(function + ": point " + std::to_string(points[k]) + ", must lie in [0, " + std::to_string(n) +
                         ")");
    }
    const int i = laplacian.representative[points[k]];
    if (laplacian.status[i] != PointStatus::active) {
      throw InvalidInput(function + ": " + whyOnNone("point", points[k], laplacian.status[i]) +
                         ", lies on no component, must be active");
    }
    b(i, static_cast<Eigen::Index>(k)) = 1;
  }
  return b;
}

}  // namespace

Eigen::MatrixXd harmonic(const Laplacian& laplacian, const Pins& pins, const SolverOptions& options,
                         SolveReport* report) {
  const Eigen::MatrixXd b = noRight(laplacian, pins.values.cols());
  return solveOnce("harmonic", laplacian, pins, b, Interpolation::harmonic, options, report);
}

Eigen::MatrixXd biharmonic(const Laplacian& laplacian, const Pins& pins, const SolverOptions& options,
                           SolveReport* report) {
  const Eigen::MatrixXd b = noRight(laplacian, pins.values.cols());
  return solveOnce("biharmonic", laplacian, pins, b, Interpolation::biharmonic, options, report);
}

Eigen::MatrixXd componentMeans(const Laplacian& laplacian, const Eigen::MatrixXd& values) {
  checkRows("componentMeans: values", laplacian, values);
  const Components components = findComponents(laplacian);
  const VectorXd weights = components.weights(laplacian.M);
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(values.rows(), values.cols());
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    VectorXd weighted = VectorXd::Zero(values.rows());
    for (const int i : components.points) weighted[i] = weights[i] * values(i, c);
    const VectorXd sums = components.sums(weighted);
    for (const int i : components.points) means(i, c) = sums[components.of[i]];
  }
  copyToCoincident(laplacian, means);
  return means;
}

Eigen::MatrixXd poisson(const Laplacian& laplacian, const Eigen::MatrixXd& f, const SolverOptions& options,
                        SolveReport* report) {
  const Stopwatch watch;
  checkRight("poisson", laplacian, f);
  return solveBalanced("poisson", laplacian, systemOf("poisson", laplacian, options), weighted(laplacian, f), watch,
                       options.progress, report);
}

Eigen::MatrixXd poisson(const Laplacian& laplacian, const Eigen::MatrixXd& f, const Pins& pins,
                        const SolverOptions& options, SolveReport* report) {
  checkRight("poisson", laplacian, f);
  checkColumns(f, pins.values);
  return solveOnce("poisson", laplacian, pins, weighted(laplacian, f), Interpolation::harmonic, options, report);
}

Eigen::MatrixXd greensFunction(const Laplacian& laplacian, const std::vector<int>& points, const SolverOptions& options,
                               SolveReport* report) {
  const std::string function = "greensFunction";
  const Stopwatch watch;
  checkSizes(function, laplacian);
  const Eigen::MatrixXd b = unitSources(function, laplacian, points);
  return solveBalanced(function, laplacian, systemOf(function, laplacian, options), b, watch, options.progress, report);
}

struct InterpolationSolver::State {
  Laplacian laplacian;
  Interpolator interpolator;
};

InterpolationSolver::InterpolationSolver(const Laplacian& laplacian, std::vector<int> points, Interpolation kind,
                                         const SolverOptions& options) {
  constexpr const char* function = "InterpolationSolver";
  Interpolator interpolator(function, laplacian, std::move(points), kind, options);
  state_ = std::make_unique<const State>(State{keptLaplacian(laplacian), std::move(interpolator)});
}

Eigen::MatrixXd InterpolationSolver::query(const Eigen::MatrixXd& values, SolveReport* report,
                                           const Progress& progress) const {
  const Stopwatch watch;
  const Laplacian& laplacian = state_->laplacian;
  const Interpolator& interpolator = state_->interpolator;
  const std::string function = interpolator.kind() == Interpolation::harmonic ? "harmonic" : "biharmonic";
  checkPinnedValues(function, interpolator.points(), values);
  const Eigen::MatrixXd b = noRight(laplacian, values.cols());
  return interpolator.solve(function, laplacian, values, b, watch, 0, progress, report);
}

Eigen::MatrixXd InterpolationSolver::queryPoisson(const Eigen::MatrixXd& f, const Eigen::MatrixXd& values,
                                                  SolveReport* report, const Progress& progress) const {
  const Stopwatch watch;
  const Laplacian& laplacian = state_->laplacian;
  const Interpolator& interpolator = state_->interpolator;
  checkRight("poisson", laplacian, f);
  checkPinnedValues("poisson", interpolator.points(), values);
  checkColumns(f, values);
  return interpolator.solve("poisson", laplacian, values, interpolator.rightOf(laplacian, f), watch, 0, progress,
                            report);
}

const SolverReport& InterpolationSolver::report() const {
  return state_->interpolator.solver().report();
}

struct PoissonSolver::State {
  Laplacian laplacian;
  LinearSystem system;
};

PoissonSolver::PoissonSolver(const Laplacian& laplacian, const SolverOptions& options) {
  constexpr const char* function = "PoissonSolver";
  checkSizes(function, laplacian);
  LinearSystem system = systemOf(function, laplacian, options);
  state_ = std::make_unique<const State>(State{keptLaplacian(laplacian), std::move(system)});
}

Eigen::MatrixXd PoissonSolver::query(const Eigen::MatrixXd& f, SolveReport* report, const Progress& progress) const {
  const Stopwatch watch;
  const Laplacian& laplacian = state_->laplacian;
  checkRight("poisson", laplacian, f);
  return solveBalanced("poisson", laplacian, state_->system, weighted(laplacian, f), watch, progress, report);
}

Eigen::MatrixXd PoissonSolver::queryGreen(const std::vector<int>& points, SolveReport* report,
                                          const Progress& progress) const {
  const Stopwatch watch;
  const Laplacian& laplacian = state_->laplacian;
  const Eigen::MatrixXd b = unitSources("greensFunction", laplacian, points);
  return solveBalanced("greensFunction", laplacian, state_->system, b, watch, progress, report);
}

const SolverReport& PoissonSolver::report() const {
  return state_->system.report();
}

}  // namespace tufted
