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

struct SolverOptions {
  SolverMethod method = SolverMethod::automatic;
  /// Bytes that a factor may take, for `automatic`; those of all factors together, where a function holds several. 0:
  /// half of the available memory, of the system or of the process's control group, whichever is less.
  std::size_t memory_limit = 0;
  /// Multigrid: |b - A x| <= tolerance |b| in the end, or where the rounding of x alone leaves more, a backward error
  /// of at most 1e-13, see SolveReport; in (0, 1).
  double tolerance = 1e-12;
  int max_iterations = 500;  ///< multigrid: of conjugate gradients, >= 1; beyond them SolverFailure
  int threads = 0;           ///< at most this many, over right sides; 0: one per processor
  Progress progress = {};    ///< while the solver is made; functions that make and use one show their solves, too
};

/// What making a solver did.
struct SolverReport {
  std::string method;            ///< "Cholesky (CHOLMOD, AMD)", "multigrid", ...
  std::int64_t unknowns = 0;     ///< rows of the system after rows of zeros, and pins of a Laplacian, are left out
  std::int64_t nonzeros = 0;     ///< entries of the factor, or of the matrices of all levels
  std::size_t bytes = 0;         ///< memory that they hold
  std::size_t factor_bytes = 0;  ///< what a factor takes or would take, where it was estimated
  std::int64_t components = 0;   ///< of a Laplacian; 0 otherwise
  double seconds = 0;            ///< wall-clock
  bool iterative = false;        ///< by multigrid, not by a factor
};

/// Two parts of a system that next to nothing joins: no weight between them exceeds 1e-6 of the smaller diagonal.
struct WeakJoint {
  int first = -1;                  ///< the smallest index of a point in one part
  int second = -1;                 ///< the same of the other; -1: next to nothing joins the first part to anything
  std::int64_t first_points = 0;   ///< size of the one part
  std::int64_t second_points = 0;  ///< size of the other
  double weight = 0;               ///< sum of the weights between them
};

/// What a solve did.
struct SolveReport {
  std::string method;  ///< that of the solver, see SolverReport
  int iterations = 0;  ///< the most of any right side, all corrections together; 0 by Cholesky
  /// Greatest |b - A x| / |b| of any right side, Euclidean norms. Of a Laplacian b - A x is that without the means of
  /// b, and |b| has them, here and below.
  double residual = 0;
  double backward_error = 0;  ///< greatest |b - A x|_i / (|A| |x| + |b|)_i of any row i and right side
  double seconds = 0;         ///< wall-clock
  /// Where the residual stays above 1e-8 because the system is nearly disconnected: between which parts. x jumps there
  /// by so much that its last digits alone leave such a residual; the backward error is small all the same.
  std::optional<WeakJoint> weak_joint = {};
};

/// Solves systems with one symmetric matrix and many right sides: prepared once, used often. `solve` may be called from
/// several threads at once. The same bits result for any number of threads.
class Solver {
 public:
  /// For a positive definite matrix, such as M + t L, or L over the points that are not pinned.
  /// @param A N x N, of which the lower triangle is read. Rows of zeros stay out: x is 0 there and b is not looked at.
  /// @throws InvalidInput when A is not square or the options are out of range
  /// @throws SolverFailure when A is not finite or not positive definite, or no memory suffices
  /// @throws Cancelled when `options.progress` returns false
  static Solver positiveDefinite(const SparseMatrix& A, const SolverOptions& options = {});

  /// For L x = b. L is singular, a constant per connected component: so of b every component loses M times the mean
  /// sum(b) / sum(M), and x has sum(M x) = 0 on every component. (A component whose areas all underflow is weighed
  /// equally.) Inside, one point of each component is pinned, and of each part of it that next to nothing joins to the
  /// rest (see WeakJoint), whose constants are found by themselves; nothing is shifted. The result is symmetric in b
  /// and x. x is 0 and b is not looked at where points are not active.
  /// @throws InvalidInput for options out of range or arrays of the wrong size
  /// @throws SolverFailure when L is not finite or not positive semidefinite, or no memory suffices
  /// @throws Cancelled when `options.progress` returns false
  static Solver laplacian(const Laplacian& laplacian, const SolverOptions& options = {});

  /// The backward error is measured, and where it exceeds 1e-13, or parts of a Laplacian are badly joined, what is
  /// missing is solved for again.
  /// @param b N x c right sides, which must be finite where they are looked at; several at once cost less
  /// @return N x c
  /// @throws InvalidInput for a wrong number of rows or right sides that are not finite
  /// @throws SolverFailure when the backward error of a solve by a factor stays above 1e-13, when multigrid does not
  ///         reach its tolerance, when x overflows, or when memory does not suffice
  /// @throws Cancelled when `progress` returns false
  Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b, SolveReport* report = nullptr,
                        const Progress& progress = {}) const;

  const SolverReport& report() const;

  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;
  ~Solver();

 private:
  struct State;
  explicit Solver(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace tufted
