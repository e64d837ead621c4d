#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/power_of_two.h"
#include "operators/distinct_faces.h"
#include "tufted/intrinsic_triangulation.h"
#include "tufted/laplacian.h"
#include "tufted/types.h"

// The distinct faces of the cover, in the form that marching and paths need.

namespace tufted {

/// A triangle by its lengths. Side `k` lies opposite corner `k`.
struct MarchFace {
  std::array<int, 3> corners;
  std::array<int, 3> edges;        ///< edge of each side
  std::array<double, 3> opposite;  ///< length of each side
  double signed_area;              ///< base times height; its sign is that of isBent(), which saves 8 bytes

  double doubleArea() const { return std::abs(signed_area); }
  /// Whether a side is longer than the straight line between its ends in MarchFaces::positions.
  bool isBent() const { return std::signbit(signed_area); }
};

/// Triangles with their edges, and those that meet at each vertex and edge, in any number. Slot 3 f + k is corner k of
/// face f and the side opposite it. Faces without area are kept, as paths run along their edges.
struct MarchFaces {
  int vertices = 0;
  int edges = 0;     ///< number of edges; sides with the same ends and length are one edge
  int exponent = 0;  ///< lengths are in units of 2^exponent of the caller's
  std::vector<MarchFace> faces;
  /// Position of each vertex, in the unit of the lengths; empty if not known, and no face is bent then. The midpoint of
  /// an edge counts as halfway between its ends, though a bent edge passes beside that.
  std::vector<Eigen::Vector3d> positions;
  std::vector<int> corner_offset, corner_slots;  ///< vertices + 1; slots by the vertex at their corner
  std::vector<int> edge_offset, edge_slots;      ///< edges + 1; slots by the edge of their side
  /// For each slot of a side from a vertex to itself, which end of the edge (0 or 1) the next corner is; otherwise or
  /// if unknown -1. May be empty; see setLoopEnds().
  std::vector<std::int8_t> loop_end;

  int vertexAt(int slot) const { return faces[slot / 3].corners[slot % 3]; }
  int edgeAt(int slot) const { return faces[slot / 3].edges[slot % 3]; }
  double lengthAt(int slot) const { return faces[slot / 3].opposite[slot % 3]; }
  Eigen::Vector3d middleOf(int edge) const {
    const int side = edge_slots[edge_offset[edge]];
    return positions[vertexAt(nextSide(side))] / 2 + positions[vertexAt(previousSide(side))] / 2;
  }
  bool isLoop(int side) const { return vertexAt(nextSide(side)) == vertexAt(previousSide(side)); }
  /// Which end (0 or 1) of an edge from a vertex to itself a corner of its side is; 0 on other edges.
  int endAt(int side, int corner) const {
    return !isLoop(side) ? 0 : corner == nextSide(side) ? loop_end[side] : 1 - loop_end[side];
  }
  std::size_t bytes() const;
};

/// The third slot of the face of two slots.
constexpr int thirdSlot(int a, int b) {
  return a / 3 * 3 + (3 - a % 3 - b % 3);
}

/// Makes the faces for a march.
/// @param faces distinct ones with corners in [0, vertices)
/// @param exponent lengths are divided by 2^exponent
/// @param split how often each face is cut into four, 0 to 2. The march itself makes the last cut, the one before is
/// stored here: the midpoint of edge e of the given faces is then vertex `vertices + e`.
/// @param positions of each vertex, in the caller's unit; no rows: not known
/// @param number the vertex of each row of `positions`, a permutation; empty: unchanged
MarchFaces marchFaces(std::vector<DistinctFace> faces, int vertices, int exponent, int split, const Workers& workers,
                      const Points& positions = {}, const std::vector<int>& number = {});
/// Makes the faces of a Laplacian's cover for a march.
/// @param number new number of each point, a permutation; empty: unchanged, and without positions
MarchFaces marchFaces(const Laplacian& laplacian, int split, const Workers& workers,
                      const std::vector<int>& number = {});

/// A position times a power of two.
inline Eigen::Vector3d scaledPosition(const Eigen::RowVector3d& position, const PowerOfTwo& unit) {
  return {unit.times(position.x()), unit.times(position.y()), unit.times(position.z())};
}

/// Sets `loop_end` from the gluing of the cover. Flips leave edges from a vertex to itself at rims, half on the front
/// and half on the back, and around necks.
/// @param faces of the cover, with its numbers and not cut
void setLoopEnds(const IntrinsicTriangulation& cover, MarchFaces& faces);

/// Numbers points in the order of first use by the faces of the cover. Those of clouds follow the Morton curve, so
/// neighbours are near each other in memory.
std::vector<int> numbersByFaces(const Laplacian& laplacian);

/// How often to cut the faces: `split` or, if empty, the default of DistanceOptions::split.
/// @param function named in errors
/// @throws InvalidInput for a split outside [0, 2]
int checkedSplit(const std::string& function, std::optional<int> split, const Laplacian& laplacian);

}  // namespace tufted
