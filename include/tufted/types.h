#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

namespace tufted {

/// N x 3 positions or directions, one row per point, in the caller's unit of length.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// F x 3 vertex indices, one row per triangle.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// Positions that somebody else holds, borrowed for a call. A Points, an Eigen::Map<const Points> of any other memory
/// with three doubles per row, and contiguous rows of either are not copied; other expressions of Eigen are.
using PointsRef = Eigen::Ref<const Points, Eigen::Unaligned, Eigen::OuterStride<3>>;
/// Triangles that somebody else holds, borrowed for a call; see PointsRef.
using TrianglesRef = Eigen::Ref<const Triangles, Eigen::Unaligned, Eigen::OuterStride<3>>;
/// N x k neighbour indices, one row per point; negative entries are padding.
using Neighborhoods = Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
/// Vertex indices of each polygon, in order around it.
using Polygons = std::vector<std::vector<int>>;

using SparseMatrix = Eigen::SparseMatrix<double>;
using VectorXd = Eigen::VectorXd;

/// What a Laplacian is of; its scale depends on that, see Laplacian.
enum class Kind : std::uint8_t {
  cloud,  ///< points alone: a triangle lies under the cover once for each corner that found it
  mesh,   ///< points and triangles: each lies under the cover once
};

/// Why a point does or does not take part. A point that does not take part has a zero row, column and mass.
enum class PointStatus : std::uint8_t {
  active = 0,      ///< has a positive diagonal in L
  not_finite = 1,  ///< NaN, infinite, or more than 1e70 median spreads or 1e152 away from the rest
  coincident = 2,  ///< equals an earlier point, its `representative`; of meshes with MeshOptions::weld
  isolated = 3,    ///< no triangle: too few neighbours, all collinear or of other sheets, an outlier, or a vertex that
                   ///< no triangle names
};

/// Why the surface ends at a point. This follows from what lies beyond, where triangles are missing around the point:
/// the middle half of the gap between its triangles is searched, as far as twice its longest edge to a neighbour.
enum class Boundary : std::uint8_t {
  none = 0,  ///< the surface does not end: triangles all around; isolated points belong to no surface that could end
  rim = 1,   ///< nothing lies beyond: the sampling ends, at a border or at a hole (meshes: a vertex of a free edge)
  jump = 2,  ///< another surface lies beyond: behind, before or beside this one, as at a depth discontinuity
  lost = 3,  ///< this surface goes on, but its triangles were dropped or not found: an outlier, uneven sampling;
             ///< also where none of the point's own triangles is left, but others name it
};

}  // namespace tufted
