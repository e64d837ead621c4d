#pragma once

#include <Eigen/Core>

#include "base/parallel.h"

namespace tufted {

// Products of tall, narrow matrices by blocks of rows, summed in a fixed order: the same bits for any number of
// threads.

/// The products X^T diag(weights) Y of X (n x a) and Y (n x b).
Eigen::MatrixXd innerProducts(const Eigen::Ref<const Eigen::MatrixXd>& X, const Eigen::VectorXd& weights,
                              const Eigen::Ref<const Eigen::MatrixXd>& Y, const Workers& workers);

/// Computes Y -= X C.
void subtractProduct(Eigen::Ref<Eigen::MatrixXd> Y, const Eigen::Ref<const Eigen::MatrixXd>& X,
                     const Eigen::MatrixXd& C, const Workers& workers);

/// Computes Y = X C; Y may be columns of X.
void multiplyInto(const Eigen::Ref<const Eigen::MatrixXd>& X, const Eigen::MatrixXd& C, Eigen::Ref<Eigen::MatrixXd> Y,
                  const Workers& workers);

/// Computes X = X C, where C has no more columns than X; further columns of X do not change.
void multiplyInPlace(Eigen::Ref<Eigen::MatrixXd> X, const Eigen::MatrixXd& C, const Workers& workers);

/// Changes X so that X^T diag(mass) X is the identity, by the Cholesky factor of this product.
/// @return false, and X as it was, if columns are dependent
bool orthonormalize(const Eigen::VectorXd& mass, const Workers& workers, Eigen::Ref<Eigen::MatrixXd> X);

}  // namespace tufted
