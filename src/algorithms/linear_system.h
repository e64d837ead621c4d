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

/// How a system is solved whose factor takes more memory than it may.
enum class IfTooLarge {
  multigrid,  ///< by multigrid
  refuse,     ///< not at all, with SolverFailure: multigrid is not fit for the matrix
  nothing,    ///< not at all: report().iterative says so, and solve() must not be called
};

/// Names for a system's errors: the function that was called, and what its caller can change.
struct SystemNames {
  std::string function;
  std::string matrix;  ///< "L", "M + t L"
  std::string if_indefinite = "validate() names what is wrong with the Laplacian";
  std::string if_slow = "raise max_iterations or tolerance, or set method to SolverMethod::cholesky";
  std::string if_large = "set method to SolverMethod::multigrid";
  IfTooLarge if_too_large = IfTooLarge::multigrid;
};

/// Solves by a factor end with a backward error of at most this, or in SolverFailure. It is a few hundred roundings;
/// all of 37,032 solves on spheres of 50 to 1,000 points kept it.
constexpr double most_backward_error = 1e-13;

/// When the solution of a system is corrected by solving for the remainder.
enum class Refine {
  never,         ///< never, and the backward error is not measured: the caller does both
  where_needed,  ///< if the backward error is too large, or parts of a Laplacian are badly joined
  always,        ///< always, until corrections are negligible
};

std::string bytesText(std::size_t bytes);

/// Does the work of Solver for all public functions that solve systems: errors name the function that was called.
class LinearSystem {
 public:
  /// Makes a system as Solver::positiveDefinite does.
  static LinearSystem positiveDefinite(const SystemNames& names, const SparseMatrix& A, const SolverOptions& options);
  /// Makes a system as Solver::laplacian does.
  static LinearSystem laplacian(const SystemNames& names, const Laplacian& laplacian, const SolverOptions& options);

  /// Gives a positive definite system with a factor another diagonal; the order of the unknowns is kept, which saves
  /// most of what a small system takes.
  /// @param diagonal N
  /// @throws SolverFailure as positiveDefinite()
  void setDiagonal(const Eigen::Ref<const VectorXd>& diagonal);

  /// Solves as Solver::solve does.
  /// @param function to be named in errors
  Eigen::MatrixXd solve(const std::string& function, const Eigen::Ref<const Eigen::MatrixXd>& b, SolveReport* report,
                        const Progress& progress, Refine refine = Refine::where_needed) const;

  const SolverReport& report() const { return report_; }

 private:
  LinearSystem(const SystemNames& names, const SolverOptions& options, std::size_t points);
  void prepare(const SolverOptions& options, const Workers& workers);
  [[noreturn]] void failForMemory() const;
  [[noreturn]] void failAsIndefinite() const;
  /// Makes `joints_`, which keep badly joined parts apart.
  void separate(const Components& parts, const std::vector<std::uint8_t>& floating);
  VectorXd exactSums(const Eigen::Ref<const VectorXd>& values) const;
  /// Right sides by row of the system. For a Laplacian the rows are all points and the means are taken out; otherwise
  /// the rows are the unknowns.
  struct RightSides {
    Eigen::MatrixXd values;
    Eigen::MatrixXd size;  ///< |b|, with what was taken out of it
  };
  RightSides rightSides(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  /// Solves with a Laplacian, with the first point of each part at 0.
  Eigen::MatrixXd withinParts(const Eigen::MatrixXd& right, const Tick& tick, int& iterations) const;
  /// A first solution, or a correction, by row of the system; for a Laplacian with sum(M x) = 0 on each component.
  Eigen::MatrixXd approximate(const Eigen::MatrixXd& right, const Tick& tick, int& iterations) const;
  /// Takes the sum over each component, which is rounding, out of the remainder of the solution x: from each row in
  /// proportion to the numbers that are added up there, so that no row has more than its share.
  /// @param size |b|
  void balance(const Eigen::Ref<const VectorXd>& size, const Eigen::Ref<const VectorXd>& x,
               Eigen::Ref<VectorXd> rest) const;
  /// Spreads the remainder at a component's pinned point, the rounding of all other points together, over these.
  void spreadPinned(const Eigen::Ref<const VectorXd>& right, Eigen::Ref<VectorXd> x) const;
  bool isGood(const Remainder& left, Eigen::Index column) const;
  /// Corrects x by solving for its remainder.
  /// @param made gets the residual, the backward error and iterations
  void improve(const std::string& function, const RightSides& right, Eigen::MatrixXd& x, Refine refine,
               const Tick& tick, SolveReport& made) const;

  [[noreturn]] void fail(const std::string& function, const NotConverged& failure) const;

  SystemNames names_;
  LongMatrix lower_;                        ///< over the unknowns; of a Laplacian only while it is factorised
  Selection unknowns_;                      ///< of all points
  std::optional<Components> components_;    ///< of a Laplacian
  std::unique_ptr<PartConstants> joints_;   ///< of a Laplacian with badly joined parts
  std::vector<int> pinned_;                 ///< of a Laplacian: the first point of each component
  VectorXd spread_;                         ///< N; of a Laplacian with a factor: see spreadPinned
  VectorXd weights_;                        ///< N; of a Laplacian: M over its sum per component
  SparseMatrix L_;                          ///< of a Laplacian, without weights that join nothing
  std::unique_ptr<LinearBackend> backend_;  ///< none: no unknowns
  SolverReport report_;
  double tolerance_;
  int threads_;
};

/// Adds the report on one system to that on all systems of a solver.
void addReport(const SolverReport& added, SolverReport& all);

}  // namespace tufted
