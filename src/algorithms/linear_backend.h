#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "base/parallel.h"
#include "operators/lower_triangle.h"

namespace tufted {

/// Thrown if `max_iterations` do not suffice; LinearSystem turns it into a SolverFailure.
struct NotConverged {
  int iterations;
  double residual;  ///< |b - A x| / |b|
};

/// Called with the fraction of a solve that is done; may throw to cancel it.
using Tick = std::function<void(double)>;

/// A positive definite system, prepared for repeated solves.
class LinearBackend {
 public:
  virtual ~LinearBackend() = default;
  /// Replaces right sides (n x c) by solutions. May be called from several threads at once.
  /// @return most iterations of any column; 0 with a factor
  /// @throws NotConverged, std::bad_alloc, and what `tick` throws
  virtual int solve(Eigen::Ref<Eigen::MatrixXd> x, const Tick& tick) const = 0;
  /// Replaces the factor by that of another matrix with the same pattern, in the same memory and order. False if that
  /// matrix is not positive definite or there is no factor; solve() must not be called then.
  /// @throws std::bad_alloc
  virtual bool refactor(const LongMatrix& /*lower*/) { return false; }

  std::string name;
  std::int64_t nonzeros = 0;
  std::size_t bytes = 0;
};

/// A sparse Cholesky factorisation in two steps: symbolic analysis, then the factor on demand.
class Cholesky {
 public:
  /// Orders and analyses the lower triangle of a symmetric matrix, which is borrowed.
  /// @param limit bytes; if the factor needs more, an ordering that saves memory is tried, if there is one
  Cholesky(const LongMatrix& lower, std::size_t limit);
  ~Cholesky();
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  /// Memory that the factor takes.
  std::size_t bytes() const;
  /// Computes the factor; to be called once. Null if the matrix is not positive definite.
  /// @throws std::bad_alloc
  std::unique_ptr<LinearBackend> factor();

 private:
  struct Analysis;
  std::unique_ptr<Analysis> analysis_;
};

struct MultigridOptions {
  double tolerance;    ///< on |b - A x| / |b|
  int max_iterations;  ///< of conjugate gradients
};

/// Makes a solver by conjugate gradients, preconditioned by a V-cycle of smoothed aggregation (Vanek, Mandel, Brezina
/// 1996). Null if a diagonal entry is not positive.
/// @param lower lower triangle of a positive definite matrix, most of whose off-diagonals are negative
std::unique_ptr<LinearBackend> makeMultigrid(const LongMatrix& lower, const MultigridOptions& options,
                                             const Workers& workers);

}  // namespace tufted
