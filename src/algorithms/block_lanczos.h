#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "base/parallel.h"

namespace tufted {

/// An operator A that is self-adjoint and positive in the inner product x^T diag(mass) y.
struct LanczosProblem {
  std::function<Eigen::MatrixXd(const Eigen::Ref<const Eigen::MatrixXd>&)> apply;  ///< A times several columns
  /// Projects columns onto the complement of the null space of A, which is not searched for.
  std::function<void(Eigen::Ref<Eigen::MatrixXd>)> deflate;
  Eigen::VectorXd mass;    ///< n, >= 0; rows of mass 0 do not matter to A
  Eigen::Index dimension;  ///< dimension of that complement, >= `wanted`
  Eigen::Index wanted;     ///< number of pairs to find, >= 1
  /// Says whether the given eigenvalues are the `wanted` largest, so that no copy of a multiple one was missed; nullopt
  /// if unknown. May be empty.
  std::function<std::optional<bool>(const Eigen::VectorXd&)> is_complete;
};

struct LanczosOptions {
  double tolerance;    ///< on |A x - theta x| / theta, in the norm of `mass`
  int max_iterations;  ///< most blocks that A is applied to
};

struct LanczosResult {
  Eigen::VectorXd values;   ///< the `wanted` largest eigenvalues, descending; empty if `max_iterations` do not suffice
  Eigen::MatrixXd vectors;  ///< n x wanted, mass-orthonormal
  Eigen::MatrixXd images;   ///< A times `vectors`
  Eigen::VectorXd residuals;  ///< |A x - theta x| / theta of each pair, measured on `images`
  int iterations = 0;         ///< blocks that A was applied to
  /// Whether every residual is at most the tolerance plus the rounding of A, 1e-13 of the largest eigenvalue over
  /// theta.
  bool converged = false;
};

/// Largest eigenpairs by Lanczos' method with blocks of vectors, all kept orthogonal, and thick restarts. Copies of
/// multiple eigenvalues can be missed: a random block looks for them when all others have converged, unless
/// `is_complete` says that there are none.
LanczosResult largestEigenpairs(const LanczosProblem& problem, const LanczosOptions& options, const Workers& workers);

}  // namespace tufted
