#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "tufted/types.h"

namespace tufted::attacks {

/// A triangle of the union of stars, or of a mesh.
struct StarTriangle {
  std::array<int, 3> corner;
  int star = -1;  ///< the point whose star it is of; -1: a triangle of a mesh
};

/// L and M by the plainest code: Algorithm 1 on lists of sides, flips one by one in long double, dense matrices. For
/// small inputs.
struct DenseResult {
  Eigen::MatrixXd L;
  VectorXd M;
  int flips = 0;
  double aspect = 1;      ///< largest ratio of longest side and height of all faces that were ever there, but flat ones
  bool has_flat = false;  ///< whether flips left a face without area, so that L is not defined
  bool has_tie = false;   ///< whether flips left an edge with cot + cot = 0, so that M depends on the order of flips
  bool is_endless = false;  ///< whether flips were given up
  /// By how much the circular order of the triangles around an edge turns further than once, in radians.
  double worst_order = 0;
};

/// @param scale 1/2 for meshes, 1/6 for clouds
DenseResult denseLaplacian(const Points& points, std::span<const StarTriangle> triangles, double scale);

/// What the star of the origin is, with ties settled by rank (section 6 of docs/algorithm.md).
struct TiedStar {
  std::vector<std::array<int, 2>> triangles;  ///< ranks of the two link vertices, counterclockwise
  bool closed = false;
  bool doubtful = false;  ///< whether it hangs on the sign of an angle that is 0 or pi but for rounding
};

/// The star of point `p` at the origin in CGAL's Delaunay triangulation, with the faces that are cocircular within
/// 1e-9 rad joined to polygons, and each polygon cut into a fan around its smallest rank.
/// @param ranks of the rows of `plane`
TiedStar tiedStar(int p, const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& plane,
                  const std::vector<int>& ranks);

}  // namespace tufted::attacks
