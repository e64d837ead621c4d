#pragma once

#include <memory>
#include <optional>
#include <string>

#include "algorithms/connected.h"
#include "algorithms/linear_backend.h"
#include "operators/lower_triangle.h"
#include "tufted/solver.h"

namespace tufted {

/// What errors say about a system: who was called, and what that caller can change.
struct SystemNames {
  std::string function;
  std::string matrix;  ///< "L", "M + t L"
  std::string if_indefinite = "validate() names what is wrong with the Laplacian";
  std::string if_slow = "raise max_iterations or tolerance, or set method to SolverMethod::cholesky";
  std::string if_large = "set method to SolverMethod::multigrid";
  bool factor_only = false;  ///< multigrid is not fit for the matrix
};

/// What Solver does, for all public functions that solve systems: errors name the one that was called.
class LinearSystem {
 public:
  /// As Solver::positiveDefinite.
  static LinearSystem positiveDefinite(const SystemNames& names, const SparseMatrix& A, const SolverOptions& options);
  /// As Solver::laplacian.
  static LinearSystem laplacian(const SystemNames& names, const Laplacian& laplacian, const SolverOptions& options);

  /// As Solver::solve.
  /// @param function to be named in errors
  Eigen::MatrixXd solve(const std::string& function, const Eigen::Ref<const Eigen::MatrixXd>& b, SolveReport* report,
                        const Progress& progress) const;

  const SolverReport& report() const { return report_; }

 private:
  LinearSystem(const SystemNames& names, const SolverOptions& options, std::size_t points);
  void prepare(const SolverOptions& options, const Workers& workers);
  /// The right sides of the unknowns; of a Laplacian without their means.
  Eigen::MatrixXd gathered(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  /// Solutions into rows of points; of a Laplacian with sum(M x) = 0 on each component. Other rows are left as they
  /// are.
  void scatter(const Eigen::MatrixXd& solution, Eigen::Ref<Eigen::MatrixXd> x) const;
  /// Greatest |b - A x| / |b|, of a Laplacian for b without its means.
  double residualOf(const Eigen::Ref<const Eigen::MatrixXd>& b, const Eigen::Ref<const Eigen::MatrixXd>& x) const;

  SystemNames names_;
  LongMatrix lower_;                        ///< over the unknowns
  Selection unknowns_;                      ///< of all points
  std::optional<Components> components_;    ///< of a Laplacian
  VectorXd weights_;                        ///< N; of a Laplacian: M over its sum per component
  SparseMatrix L_;                          ///< of a Laplacian, for the residual
  std::unique_ptr<LinearBackend> backend_;  ///< none: no unknowns
  SolverReport report_;
  double tolerance_;
  int threads_;
};

}  // namespace tufted
