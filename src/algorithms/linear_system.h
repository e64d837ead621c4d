#pragma once

#include <memory>
#include <optional>
#include <string>

#include "algorithms/connected.h"
#include "algorithms/linear_backend.h"
#include "algorithms/nearly_disconnected.h"
#include "algorithms/remainder.h"
#include "operators/lower_triangle.h"
#include "tufted/solver.h"

namespace tufted {

/// How a system is solved if its factor exceeds the memory limit.
enum class IfTooLarge {
  multigrid,  ///< by multigrid
  refuse,     ///< not at all: throws SolverFailure, because multigrid does not suit the matrix
  nothing,    ///< not at all: report().iterative says so, and solve() must not be called
};

/// Texts for a system's errors: the function that was called, and what its caller can change.
struct SystemNames {
  std::string function;
  std::string matrix;  ///< "L", "M + t L"
  std::string if_indefinite = "validate() names what is wrong with the Laplacian";
  std::string if_slow = "raise max_iterations or tolerance, or set method to SolverMethod::cholesky";
  std::string if_large = "set method to SolverMethod::multigrid";
  IfTooLarge if_too_large = IfTooLarge::multigrid;
};

/// Largest backward error of a solve by a factor; above it, SolverFailure is thrown. It is a few hundred roundings; all
/// of 37,032 solves on spheres of 50 to 1,000 points met it.
constexpr double most_backward_error = 1e-13;
/// In M / t + L a mass below this part of the diagonal of L is raised to it. In the sum it would be lost; so the matrix
/// stays a positive definite M-matrix, and the maximum principle holds for any time step.
constexpr double least_mass = 1e-13;
/// The tolerance of conjugate gradients for heat, near the best that they reach, as heat is used far below its largest
/// value.
constexpr double heat_tolerance = 1e-12;

/// When the solution of a system is corrected by solving for the remainder.
enum class Refine {
  never,         ///< never, and the backward error is not measured: the caller does both
  where_needed,  ///< if the backward error is too large, or parts of a Laplacian are joined by tiny weights only
  always,        ///< always, until corrections are negligible
};

std::string bytesText(std::size_t bytes);

/// The implementation of Solver, used by all public functions that solve systems; errors name the public function
/// (docs/algorithm.md, section 16).
class LinearSystem {
 public:
  /// Makes a system as Solver::positiveDefinite does.
  static LinearSystem positiveDefinite(const SystemNames& names, const SparseMatrix& A, const SolverOptions& options);
  /// Makes a system as Solver::laplacian does.
  static LinearSystem laplacian(const SystemNames& names, const Laplacian& laplacian, const SolverOptions& options);

  /// Replaces the diagonal of a positive definite system and factors it again. The order of the unknowns is kept, which
  /// saves most of the time for a small system.
  /// @param diagonal N
  /// @throws SolverFailure if the matrix is then not positive definite, or memory does not suffice
  void setDiagonal(const Eigen::Ref<const VectorXd>& diagonal);

  /// Solves as Solver::solve does.
  /// @param function named in errors
  Eigen::MatrixXd solve(const std::string& function, const Eigen::Ref<const Eigen::MatrixXd>& b, SolveReport* report,
                        const Progress& progress, Refine refine = Refine::where_needed) const;

  const SolverReport& report() const { return report_; }

 private:
  LinearSystem(const SystemNames& names, const SolverOptions& options, std::size_t points);
  void prepare(const SolverOptions& options, const Workers& workers);
  [[noreturn]] void failForMemory() const;
  [[noreturn]] void failAsIndefinite() const;
  /// Makes `joints_`, which solve for parts joined by tiny weights.
  void separate(const Components& parts, const std::vector<std::uint8_t>& floating);
  VectorXd exactSums(const Eigen::Ref<const VectorXd>& values) const;
  /// Right sides by row of the system. For a Laplacian the rows are all points and the means are subtracted; otherwise
  /// the rows are the unknowns.
  struct RightSides {
    Eigen::MatrixXd values;
    Eigen::MatrixXd size;  ///< |b|, plus what was subtracted from it
  };
  RightSides rightSides(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  /// Solves with a Laplacian, the first point of each part held at 0.
  Eigen::MatrixXd withinParts(const Eigen::MatrixXd& right, const Tick& tick, int& iterations) const;
  /// A first solution or a correction, by row of the system; for a Laplacian with sum(M x) = 0 on each component.
  Eigen::MatrixXd approximate(const Eigen::MatrixXd& right, const Tick& tick, int& iterations) const;
  /// Subtracts the sum over each component, which is rounding, from the remainder of the solution x: in each row in
  /// proportion to the magnitudes that are added up there.
  /// @param size |b|
  void balance(const Eigen::Ref<const VectorXd>& size, const Eigen::Ref<const VectorXd>& x,
               Eigen::Ref<VectorXd> rest) const;
  /// Distributes the remainder at each pinned point, which is the summed rounding of its component, over all points.
  void spreadPinned(const Eigen::Ref<const VectorXd>& right, Eigen::Ref<VectorXd> x) const;
  bool isGood(const Remainder& left, Eigen::Index column) const;
  /// Corrects x by solves for its remainder b - A x.
  /// @param made gets the residual, the backward error and iterations
  void improve(const std::string& function, const RightSides& right, Eigen::MatrixXd& x, Refine refine,
               const Tick& tick, SolveReport& made) const;

  [[noreturn]] void fail(const std::string& function, const NotConverged& failure) const;

  SystemNames names_;
  LongMatrix lower_;         ///< lower triangle over the unknowns; for a Laplacian only while it is factorised
  NumberedPoints unknowns_;  ///< the points that are solved for
  std::optional<Components> components_;    ///< for a Laplacian
  std::unique_ptr<PartConstants> joints_;   ///< for a Laplacian with parts joined by tiny weights
  std::vector<int> pinned_;                 ///< for a Laplacian: the first point of each component
  VectorXd spread_;                         ///< N; for a Laplacian with a factor: see spreadPinned()
  VectorXd weights_;                        ///< N; for a Laplacian: see Components::weights()
  SparseMatrix L_;                          ///< for a Laplacian: L without weights between components
  std::unique_ptr<LinearBackend> backend_;  ///< null if there are no unknowns
  SolverReport report_;
  double tolerance_;
  int threads_;
};

/// Adds the report of one system to that of all systems of a solver.
void addReport(const SolverReport& added, SolverReport& all);

}  // namespace tufted
