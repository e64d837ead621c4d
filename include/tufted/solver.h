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

/// How a linear system is solved.
enum class SolverMethod {
  automatic,  ///< by Cholesky if the factor fits into `memory_limit`, otherwise by multigrid
  cholesky,   ///< factor once, solve often: CHOLMOD with TUFTED_WITH_GPL, Eigen's SimplicialLDLT without
  multigrid,  ///< conjugate gradients preconditioned by algebraic multigrid: memory in proportion to the matrix
};

/// Options of Solver.
struct SolverOptions {
  SolverMethod method = SolverMethod::automatic;  ///< how systems are solved
  /// Most bytes that a factor may take, for `automatic`; of a function that holds several factors, all together. 0:
  /// half of the memory available to the system or to the process's control group, whichever is less.
  std::size_t memory_limit = 0;
  /// Tolerance of multigrid, in (0, 1): it stops when |b - A x| <= tolerance |b|, or, where the rounding of x leaves
  /// more than that, at a backward error of at most 1e-13 (see SolveReport).
  double tolerance = 1e-12;
  int max_iterations = 500;  ///< conjugate gradient iterations of multigrid, >= 1; SolverFailure if they do not suffice
  int threads = 0;           ///< at most this many threads, over right sides; 0: one per processor
  Progress progress = {};  ///< called while the solver is made, and during solves by a function that makes and uses it
};

/// How a solver was made, and what it holds.
struct SolverReport {
  std::string method;            ///< "Cholesky (CHOLMOD, AMD)", "multigrid", ...
  std::int64_t unknowns = 0;     ///< rows of the system solved, without empty rows and without pins of a Laplacian
  std::int64_t nonzeros = 0;     ///< entries of the factor, or of the matrices of all levels
  std::size_t bytes = 0;         ///< memory held by the factor, or by the matrices of all levels
  std::size_t factor_bytes = 0;  ///< memory that a factor takes or would take; 0 if it was not estimated
  std::int64_t components = 0;   ///< connected components of a Laplacian; 0 for other matrices
  double seconds = 0;            ///< wall-clock
  bool iterative = false;        ///< whether systems are solved by multigrid instead of a factor
};

/// Two parts of a system that are nearly disconnected: no weight between them exceeds 1e-6 of the smaller diagonal.
struct WeakJoint {
  int first = -1;                  ///< the smallest index of a point in the first part
  int second = -1;                 ///< the smallest index in the second part; -1: the first is joined to no other part
  std::int64_t first_points = 0;   ///< number of points in the first part
  std::int64_t second_points = 0;  ///< number of points in the second part
  double weight = 0;               ///< sum of the weights between the two parts
};

/// Accuracy and cost of a solve.
struct SolveReport {
  std::string method;  ///< method of the solver, see SolverReport
  int iterations = 0;  ///< iterations of the slowest right side, with those of its corrections; 0 with Cholesky
  /// Greatest |b - A x| / |b| of any right side, Euclidean norms. For a Laplacian the means of b are left out of
  /// b - A x, but not of |b|.
  double residual = 0;
  /// Greatest |b - A x|_i / (|A| |x| + |b|)_i of any row i and right side. For a Laplacian the means of b are left out
  /// of b - A x, but not of |b|.
  double backward_error = 0;
  double seconds = 0;  ///< wall-clock
  /// The two parts of a nearly disconnected system, set if this is why the residual stays above 1e-8: x jumps between
  /// them by so much that rounding of x alone leaves such a residual. The backward error is small all the same.
  std::optional<WeakJoint> weak_joint = {};
};

/// Solves A x = b for one symmetric matrix A and many right sides: prepared once, used often. `solve` may be called
/// from several threads at once. The result has the same bits for any number of threads.
class Solver {
 public:
  /// Makes a solver for a positive definite matrix, such as M + t L, or L without the pinned points.
  /// @param A N x N, of which only the lower triangle is read. Empty rows are left out: there x is 0 and b is ignored.
  /// @throws InvalidInput when A is not square or the options are out of range
  /// @throws SolverFailure when A is not finite or not positive definite, or no memory suffices
  /// @throws Cancelled when `options.progress` returns false
  static Solver positiveDefinite(const SparseMatrix& A, const SolverOptions& options = {});

  /// Makes a solver for L x = b. L is singular: it maps constants on a connected component to 0. So on every component
  /// M times the mean sum(b) / sum(M) is subtracted from b, and x has sum(M x) = 0. (A component whose areas all
  /// underflow is weighted equally.) At points that are not active x is 0 and b is ignored.
  ///
  /// Inside the solver, one point is pinned in each component, and in each part of it that is nearly disconnected from
  /// the rest (see WeakJoint); the constants of such parts are found separately. The diagonal is not shifted, and x
  /// depends on b by a symmetric matrix.
  /// @throws InvalidInput for options out of range or arrays of the wrong size
  /// @throws SolverFailure when L is not finite or not positive semidefinite, or no memory suffices
  /// @throws Cancelled when `options.progress` returns false
  static Solver laplacian(const Laplacian& laplacian, const SolverOptions& options = {});

  /// Solves for several right sides. The backward error is measured; if it exceeds 1e-13, or parts of a Laplacian are
  /// nearly disconnected, the solution is corrected by solving for the remainder.
  /// @param b N x c right sides, finite where they are not ignored; several at once take less time than one by one
  /// @param report if not null, gets the accuracy and cost
  /// @return N x c solutions
  /// @throws InvalidInput for a wrong number of rows or right sides that are not finite
  /// @throws SolverFailure when the backward error with a factor stays above 1e-13, multigrid does not reach its
  /// tolerance, x overflows, or memory does not suffice
  /// @throws Cancelled when `progress` returns false
  Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b, SolveReport* report = nullptr,
                        const Progress& progress = {}) const;

  /// How the solver was made, and what it holds.
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
