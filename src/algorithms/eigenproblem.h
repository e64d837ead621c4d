#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "algorithms/connected.h"
#include "tufted/laplacian.h"

namespace tufted {

/// The eigenproblem L x = lambda diag(mass) x with masses and areas as parts of `total`, so that tiny and huge clouds
/// neither underflow nor overflow.
struct Eigenproblem {
  const SparseMatrix& L;  ///< the Laplacian's matrix, which must outlive this
  Components components;
  double total;               ///< sum of M over the active points
  VectorXd mass;              ///< N; M over `total`
  VectorXd area;              ///< area of each component, as a part of `total`
  std::vector<int> order;     ///< components of positive area, larger ones first
  Eigen::Index usable = 0;    ///< number of points of positive mass
  std::vector<int> massless;  ///< active points of no mass in components of positive area, ascending

  explicit Eigenproblem(const Laplacian& laplacian);

  /// Number of eigenvalues that are exactly 0: one for each component of positive area.
  Eigen::Index nulls() const { return std::ssize(order); }
  /// Number of eigenpairs, with or without those of eigenvalue 0.
  Eigen::Index count(bool null_space) const { return usable - (null_space ? 0 : nulls()); }

  /// The null vectors of the first `count` components in `order`, N x count, mass-orthonormal.
  Eigen::MatrixXd constants(Eigen::Index count) const;
  /// Subtracts the mean by mass over each component from columns.
  void deflate(Eigen::Ref<Eigen::MatrixXd> x) const;
  /// Sets the values at points without mass so that L x = 0 there.
  void fillMassless(Eigen::Ref<Eigen::MatrixXd> x) const;
};

/// Computes L^+ M x for several columns x, L^+ the pseudo-inverse of L.
using InverseTimes = std::function<Eigen::MatrixXd(const Eigen::Ref<const Eigen::MatrixXd>&)>;

/// Pairs of positive eigenvalues and their vectors, in ascending order.
struct Eigenpairs {
  VectorXd values;
  Eigen::MatrixXd vectors;  ///< N x k, mass-orthonormal
  Eigen::MatrixXd images;   ///< InverseTimes of `vectors`; no columns if unknown
};

}  // namespace tufted
