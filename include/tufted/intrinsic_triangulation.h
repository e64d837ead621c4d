#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tufted/detail/memory_layout.h"
#include "tufted/types.h"

namespace tufted {

/// A closed, edge-manifold, oriented triangulation given by its connectivity and edge lengths alone (Sharp and Crane
/// 2020, Sections 3.2 and 4.1). It is a Delta-complex, so two faces may share several edges, a face may be glued to
/// itself and an edge may join a vertex to itself.
///
/// Side `s` of face `f` has the number 3 f + s and runs from corner `s` to corner `(s + 1) % 3`. `glue` maps a side to
/// the one side it is glued to, its mate, which runs the other way. Before flips, faces 2 t and 2 t + 1 are the front
/// and the back of triangle t, with the corners (i, j, k) and (i, k, j).
struct IntrinsicTriangulation {
  int vertices = 0;                       ///< number of vertices; corners lie in [0, vertices)
  std::vector<std::array<int, 3>> faces;  ///< F x 3 corners
  std::vector<int> glue;                  ///< 3 F; of each side the number of its mate
  std::vector<double> length;             ///< 3 F lengths in the caller's unit, equal on both sides of an edge

  /// The number of faces, F.
  std::int64_t size() const { return static_cast<std::int64_t>(faces.size()); }
};

/// The side after `side` in its face.
constexpr int nextSide(int side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}
/// The side before `side` in its face.
constexpr int previousSide(int side) {
  return side % 3 == 0 ? side + 2 : side - 1;
}

/// Violations found by `validate`, each a number of sides or faces. All are zero for the cover of a `Laplacian`.
struct CoverCheck {
  std::int64_t not_closed = 0;           ///< sides whose mate is out of range; all sides if arrays have the wrong size
  std::int64_t not_edge_manifold = 0;    ///< sides whose mate is glued to another side, or that are glued to themselves
  std::int64_t not_oriented = 0;         ///< sides whose mate does not run the other way between the same vertices
  std::int64_t unequal_lengths = 0;      ///< sides whose mate has another length
  std::int64_t triangle_inequality = 0;  ///< faces whose lengths violate the triangle inequality by more than rounding
  /// Edges whose sum cot + cot (Sharp and Crane 2020, Equation 2) is below -tolerance and below what rounding of that
  /// sum explains, -16 epsilon (|cot| + |cot|).
  std::int64_t not_delaunay = 0;
  double smallest_cotan_sum = 0;  ///< the least cot + cot of all edges, at most 0

  /// Whether nothing is violated.
  bool ok() const {
    return not_closed + not_edge_manifold + not_oriented + unequal_lengths + triangle_inequality + not_delaunay == 0;
  }
};

/// Checks the properties of a cover on which the guarantees of L rest, in O(F). Angles of faces with lengths below
/// 1e-292 are not checked.
/// @param cover with corners in [0, vertices)
/// @param delaunay_tolerance >= 0, on cot + cot, see CoverCheck::not_delaunay
CoverCheck validate(const IntrinsicTriangulation& cover, double delaunay_tolerance = 1e-9);

}  // namespace tufted
