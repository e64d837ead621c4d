#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "algorithms/connected.h"
#include "tufted/laplacian.h"

namespace tufted {

/// The eigenproblem L x = lambda diag(mass) x without unit, so that tiny and huge clouds neither underflow nor
/// overflow: areas are parts of `total`.
struct Eigenproblem {
  const SparseMatrix& L;  ///< the Laplacian's matrix, which must outlive this
  Components components;
  double total;               ///< area of the active points
  VectorXd mass;              ///< N; masses as parts of `total`
  VectorXd area;              ///< area of each component, as a part of `total`
  std::vector<int> order;     ///< components of positive area, larger ones first
  Eigen::Index usable = 0;    ///< points of positive mass
  std::vector<int> massless;  ///< active points of no mass in components of positive area, ascending

  explicit Eigenproblem(const Laplacian& laplacian);

  /// Number of eigenvalues that are exactly 0: one for each component of positive area.
  Eigen::Index nulls() const { return std::ssize(order); }
  /// How many pairs there are.
  Eigen::Index count(bool null_space) const { return usable - (null_space ? 0 : nulls()); }

  /// The first `count` of the constants of the components, N x count, of mass 1.
  Eigen::MatrixXd constants(Eigen::Index count) const;
  /// Takes the constants out of columns.
  void deflate(Eigen::Ref<Eigen::MatrixXd> x) const;
  /// Sets points without mass to what L x = 0 demands there.
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
