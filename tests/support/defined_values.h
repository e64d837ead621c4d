#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "tufted/laplacian.h"

// Checks of what every algorithm promises for points that coincide or take no part.

namespace tufted::support {

/// Whether a point takes part, by itself or through its representative.
inline bool takesPart(const Laplacian& laplacian, Eigen::Index i) {
  return laplacian.status[laplacian.representative[i]] == PointStatus::active;
}

/// Expects copies to have the values of their representative.
inline void expectCopies(const Laplacian& laplacian, const Eigen::MatrixXd& values) {
  ASSERT_EQ(values.rows(), std::ssize(laplacian.status));
  const Eigen::MatrixXd u = values.array().isNaN().select(-1e9, values);
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    if (laplacian.status[i] == PointStatus::coincident) {
      ASSERT_EQ(u.row(i), u.row(laplacian.representative[i])) << i;
    }
  }
}

/// Expects finite values at points that take part.
/// @param elsewhere at all others: 0 or NaN
inline void expectDefined(const Laplacian& laplacian, const Eigen::MatrixXd& values, double elsewhere) {
  expectCopies(laplacian, values);
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    if (takesPart(laplacian, i)) {
      ASSERT_TRUE(values.row(i).allFinite()) << i;
    } else {
      ASSERT_TRUE(std::isnan(elsewhere) ? values.row(i).array().isNaN().all() : values.row(i).isZero(0)) << i;
    }
  }
}

}  // namespace tufted::support
