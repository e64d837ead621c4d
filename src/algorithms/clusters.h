#pragma once

#include <Eigen/Core>
#include <vector>

#include "tufted/types.h"

namespace tufted {

/// Clusters of rows by k-means (Lloyd's iterations). The first centre is the row that is farthest from the mean, each
/// next one the row that is farthest from all before it, so nothing is random and the order of the rows does not
/// matter.
/// @param rows n x d
/// @param weights n, >= 0, of the rows in the means; if all are 0, rows count equally
/// @return n numbers of clusters in [0, count)
std::vector<int> clusters(const Eigen::MatrixXd& rows, VectorXd weights, int count);

}  // namespace tufted
