#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// How a system is solved.
enum class SolverMethod {
  automatic,  ///< by Cholesky where the factor fits into `memory_limit`, else by multigrid
  cholesky,   ///< factor once, solve often: CHOLMOD with TUFTED_WITH_GPL, Eigen's SimplicialLDLT without
  multigrid,  ///< conjugate gradients preconditioned by algebraic multigrid: memory in proportion to the matrix
};

/// Options of Solver.
struct SolverOptions {
  SolverMethod method = SolverMethod::automatic;  ///< factor or multigrid
  /// Bytes that a factor may take, for `automatic`; if a function holds several factors, all of them together. 0: half
  /// of the available memory, of the system or of the process's control group, whichever is less.
  std::size_t memory_limit = 0;
  /// Tolerance of multigrid, in (0, 1): it ends with |b - A x| <= tolerance |b| or, if the rounding of x alone leaves
  /// more, with a backward error of at most 1e-13, see SolveReport.
  double tolerance = 1e-12;
  int max_iterations = 500;  ///< conjugate gradient iterations of multigrid, >= 1; SolverFailure if they do not suffice
  int threads = 0;           ///< at most this many, over right sides; 0: one per processor
  Progress progress = {};    ///< called while the solver is made, and in solves of functions that make and use one
};

/// What making a solver did.
struct SolverReport {
  std::string method;            ///< "Cholesky (CHOLMOD, AMD)", "multigrid", ...
  std::int64_t unknowns = 0;     ///< rows of the system after rows of zeros, and pins of a Laplacian, are left out
  std::int64_t nonzeros = 0;     ///< entries of the factor, or of the matrices of all levels
  std::size_t bytes = 0;         ///< memory held by the factor, or by the matrices of all levels
  std::size_t factor_bytes = 0;  ///< memory that a factor takes or would take, if it was estimated
  std::int64_t components = 0;   ///< connected components of a Laplacian; 0 for other matrices
  double seconds = 0;            ///< wall-clock
  bool iterative = false;        ///< whether systems are solved by multigrid, not by a factor
};

/// Two parts of a system that are nearly disconnected: no weight between them exceeds 1e-6 of the smaller diagonal.
struct WeakJoint {
  int first = -1;                  ///< the smallest index of a point in the first part
  int second = -1;                 ///< the smallest index in the second part; -1: the first is nearly on its own
  std::int64_t first_points = 0;   ///< number of points in the first part
  std::int64_t second_points = 0;  ///< number of points in the second part
  double weight = 0;               ///< sum of the weights between the two parts
};

/// What a solve did.
struct SolveReport {
  std::string method;  ///< method of the solver, see SolverReport
  int iterations = 0;  ///< the most of any right side, all corrections together; 0 with Cholesky
  /// Greatest |b - A x| / |b| of any right side, Euclidean norms. For a Laplacian the means of b are left out of
  /// b - A x, but not of |b|.
  double residual = 0;
  /// Greatest |b - A x|_i / (|A| |x| + |b|)_i of any row i and right side. For a Laplacian the means of b are left out
  /// of b - A x, but not of |b|.
  double backward_error = 0;
  double seconds = 0;  ///< wall-clock
  /// The two parts of a nearly disconnected system, set if this is why the residual stays above 1e-8. x jumps between
  /// them by so much that its last digits alone leave such a residual; the backward error is small all the same.
  std::optional<WeakJoint> weak_joint = {};
};

/// Solves systems with one symmetric matrix and many right sides: prepared once, used often. `solve` may be called from
/// several threads at once. The same bits result for any number of threads.
class Solver {
 public:
  /// Makes a solver for a positive definite matrix, such as M + t L, or L over the points that are not pinned.
  /// @param A N x N, of which the lower triangle is read. Rows of zeros are left out: x is 0 there and b is ignored.
  /// @throws InvalidInput when A is not square or the options are out of range
  /// @throws SolverFailure when A is not finite or not positive definite, or no memory suffices
  /// @throws Cancelled when `options.progress` returns false
  static Solver positiveDefinite(const SparseMatrix& A, const SolverOptions& options = {});

  /// Makes a solver for L x = b. L is singular, as it maps constants on a connected component to 0. So on every
  /// component M times the mean sum(b) / sum(M) is subtracted from b, and x has sum(M x) = 0. (A component whose areas
  /// all underflow is weighted equally.) Inside the solver, one point of each component is pinned, and one of each part
  /// of it that is nearly disconnected from the rest (see WeakJoint), whose constants are found by themselves; nothing
  /// is shifted. The result is symmetric in b and x. At points that are not active x is 0 and b is ignored.
  /// @throws InvalidInput for options out of range or arrays of the wrong size
  /// @throws SolverFailure when L is not finite or not positive semidefinite, or no memory suffices
  /// @throws Cancelled when `options.progress` returns false
  static Solver laplacian(const Laplacian& laplacian, const SolverOptions& options = {});

  /// Solves for several right sides. The backward error is measured; if it exceeds 1e-13, or parts of a Laplacian are
  /// nearly disconnected, the solution is corrected by solving for what is missing.
  /// @param b N x c right sides, which must be finite where they are not ignored; several at once cost less
  /// @return N x c
  /// @throws InvalidInput for a wrong number of rows or right sides that are not finite
  /// @throws SolverFailure when the backward error of a solve by a factor stays above 1e-13, when multigrid does not
  ///         reach its tolerance, when x overflows, or when memory does not suffice
  /// @throws Cancelled when `progress` returns false
  Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b, SolveReport* report = nullptr,
                        const Progress& progress = {}) const;

  /// What making the solver did.
  const SolverReport& report() const;

  /// A moved-from solver may only be destroyed or assigned to.
  Solver(Solver&&) noexcept;
  /// A moved-from solver may only be destroyed or assigned to.
  Solver& operator=(Solver&&) noexcept;
  ~Solver();

 private:
  struct State;
  explicit Solver(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace tufted
