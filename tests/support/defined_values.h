#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "tufted/laplacian.h"

// Checks of the values of every algorithm at coincident, isolated and non-finite points.

namespace tufted::support {

/// Whether a point or its representative is active.
inline bool takesPart(const Laplacian& laplacian, Eigen::Index i) {
  return laplacian.status[laplacian.representative[i]] == PointStatus::active;
}

/// Expects coincident points to have the values of their representative.
inline void expectCopies(const Laplacian& laplacian, const Eigen::MatrixXd& values) {
  ASSERT_EQ(values.rows(), std::ssize(laplacian.status));
  const Eigen::MatrixXd u = values.array().isNaN().select(-1e9, values);
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    if (laplacian.status[i] == PointStatus::coincident) {
      ASSERT_EQ(u.row(i), u.row(laplacian.representative[i])) << i;
    }
  }
}

/// Expects finite values where takesPart(), and values as expectCopies() does.
/// @param elsewhere value at all other points: 0 or NaN
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
