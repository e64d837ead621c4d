#pragma once

#include <Eigen/Core>

#include "tufted/laplacian.h"

namespace tufted {

/// Gives coincident points the values of their representative.
/// @param values N x c
template <class Values>
void copyToCoincident(const Laplacian& laplacian, Values& values) {
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    if (laplacian.status[i] == PointStatus::coincident) values.row(i) = values.row(laplacian.representative[i]);
}

}  // namespace tufted
