#pragma once

#include <Eigen/Core>
#include <vector>

#include "bench/nearest_points.h"
#include "oracles/oracles.h"

namespace tufted::bench {

/// The number of neighbours to which tangent planes are fitted and from which stars are taken, that of the paper.
inline constexpr int plane_neighbors = 30;

/// The neighbours of a point in its tangent plane.
struct Patch {
  using Plane = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
  std::vector<int> index;  ///< ascending by distance, without the point itself
  Plane plane;             ///< one row per neighbour, from the point
  VectorXd height;         ///< of each neighbour along the normal
};

/// The k nearest neighbours of a point, fewer if there are fewer points.
Patch patchOf(const NearestPoints& points, int point, int k);

/// The Delaunay star of the point of a patch among its nearest `k` neighbours; triangles name places in the patch.
oracles::PlanarStar starOf(const Patch& patch, int k);

/// The areas of all Delaunay triangles of the point and its neighbours, a third at each corner that is a
/// neighbour.
VectorXd cornerAreas(const Patch& patch);

/// L with the given weights w_ij, i != j, and rows that sum to 0. Repeated entries are added up.
SparseMatrix fromWeights(const std::vector<Eigen::Triplet<double>>& weights, Eigen::Index n);

}  // namespace tufted::bench
