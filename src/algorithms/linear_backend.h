#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "base/parallel.h"
#include "operators/lower_triangle.h"

namespace tufted {

/// Thrown where iterations do not suffice; LinearSystem makes a SolverFailure of it.
struct NotConverged {
  int iterations;
  double residual;  ///< |b - A x| / |b|
};

/// Called with the fraction of a solve that is done; may throw to end it.
using Tick = std::function<void(double)>;

/// A positive definite system, prepared.
class LinearBackend {
 public:
  virtual ~LinearBackend() = default;
  /// Replaces right sides (n x c) by solutions. May be called from several threads at once.
  /// @return iterations, the most of any column; 0 by elimination
  /// @throws NotConverged, std::bad_alloc, and what `tick` throws
  virtual int solve(Eigen::Ref<Eigen::MatrixXd> x, const Tick& tick) const = 0;

  std::string name;
  std::int64_t nonzeros = 0;
  std::size_t bytes = 0;
};

/// What symbolic analysis says of a Cholesky factor, and the factor itself on demand.
class Cholesky {
 public:
  /// Orders and analyses the lower triangle of a symmetric matrix, which is borrowed.
  /// @param limit bytes; where the first ordering leads beyond, another is tried, if there is one that saves memory
  Cholesky(const LongMatrix& lower, std::size_t limit);
  ~Cholesky();
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  /// Memory that the factor takes.
  std::size_t bytes() const;
  /// To be called once. Null when the matrix is not positive definite.
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

/// Conjugate gradients, preconditioned by a V-cycle of smoothed aggregation.
/// @param lower lower triangle of a positive definite matrix, most of whose off-diagonals are negative
/// Null when a diagonal entry is not positive.
std::unique_ptr<LinearBackend> makeMultigrid(const LongMatrix& lower, const MultigridOptions& options,
                                             const Workers& workers);

}  // namespace tufted
