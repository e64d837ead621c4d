#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/parallel.h"

namespace tufted {

/// Points in a space of any dimension, one per row.
using RowsOfNumbers = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// For each row of `asked` the nearest row of `rows` by Euclidean distance, found exactly by one of FLANN's trees.
/// @param rows at least one, with as many columns as `asked`, all finite
/// @throws Cancelled when the progress of `workers` returns false
std::vector<int> nearestRows(const RowsOfNumbers& rows, const RowsOfNumbers& asked, const Workers& workers);

}  // namespace tufted
