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
/// Positions in memory of the caller, borrowed for a call. A Points, an Eigen::Map<const Points> of any memory with
/// three doubles per row, and contiguous rows of either are not copied; other expressions of Eigen are.
using PointsRef = Eigen::Ref<const Points, Eigen::Unaligned, Eigen::OuterStride<3>>;
/// Triangles in memory of the caller, borrowed for a call; see PointsRef.
using TrianglesRef = Eigen::Ref<const Triangles, Eigen::Unaligned, Eigen::OuterStride<3>>;
/// N x k neighbour indices, one row per point; negative entries are padding.
using Neighborhoods = Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
/// Vertex indices of each polygon, in order around it (of either orientation).
using Polygons = std::vector<std::vector<int>>;

using SparseMatrix = Eigen::SparseMatrix<double>;
using VectorXd = Eigen::VectorXd;

/// What a Laplacian was built from. The scale of L depends on it, see Laplacian.
enum class Kind : std::uint8_t {
  cloud,  ///< points alone: a triangle is in the cover once for each corner whose star has it
  mesh,   ///< points and triangles: each triangle is in the cover once
};

/// Why a point does or does not take part. A point that does not has mass 0 and an empty row and column in L.
enum class PointStatus : std::uint8_t {
  active = 0,      ///< takes part: has a positive diagonal in L
  not_finite = 1,  ///< NaN, infinite, or farther than 1e70 median spreads or 1e152 from the median of all points
  coincident = 2,  ///< equals an earlier point, its `representative`; on meshes only with MeshOptions::weld
  isolated = 3,  ///< no triangle: too few neighbours, neighbours that are collinear or on other sheets, an outlier, or
                 ///< a vertex of no triangle
};

/// Why the surface ends at a point. Where triangles are missing around a point of a cloud, the middle half of the gap
/// between its triangles is searched for other points, as far as twice the longest edge of its star.
enum class Boundary : std::uint8_t {
  none = 0,  ///< the surface does not end: triangles lie all around the point, or it is isolated
  rim = 1,   ///< nothing lies beyond: the sampling ends, at a border or at a hole (meshes: a vertex of a boundary edge)
  jump = 2,  ///< another surface lies beyond: behind, before or beside this one, as at a depth discontinuity
  lost = 3,  ///< this surface goes on, but its triangles were dropped or not found, as at an outlier or where sampling
             ///< is uneven; also where other stars have the point and its own star is empty
};

}  // namespace tufted
