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
#include "operators/distinct_faces.h"
#include "tufted/intrinsic_triangulation.h"
#include "tufted/laplacian.h"
#include "tufted/types.h"

// The triangles that distances march over.

namespace tufted {

/// A triangle by its lengths. Side `k` lies opposite corner `k`.
struct MarchFace {
  std::array<int, 3> corners;
  std::array<int, 3> edges;        ///< the edge that each side is
  std::array<double, 3> opposite;  ///< length of each side
  double double_area;              ///< base times height
  bool is_bent = false;            ///< whether a side is longer than the straight line between its ends, see positions
};

/// Triangles with their edges, and which of them meet at a vertex or an edge. Any number may meet. A slot is a corner
/// of a face and the side opposite it, 3 face + corner. Faces without area stay, as edges lead along them.
struct MarchFaces {
  int vertices = 0;
  int edges = 0;     ///< sides with the same ends and length are one edge
  int exponent = 0;  ///< lengths are in units of 2^exponent of the caller's
  std::vector<MarchFace> faces;
  /// Where each vertex lies, in the unit of the lengths. Empty where that is not known; no face is bent then. The
  /// middle of an edge lies halfway between its ends, though a bent edge leads past that.
  std::vector<Eigen::Vector3d> positions;
  std::vector<int> corner_offset, corner_slots;  ///< vertices + 1; slots by the vertex at their corner
  std::vector<int> edge_offset, edge_slots;      ///< edges + 1; slots by the edge of their side
  /// For sides from a vertex to itself, whose ends the vertices do not tell apart, which end the corner after the
  /// side's own is: 0 or 1, or -1 where that is not known. Empty, or 3 for each face; see setLoopEnds().
  std::vector<std::int8_t> loop_end;

  int vertexAt(int slot) const { return faces[slot / 3].corners[slot % 3]; }
  int edgeAt(int slot) const { return faces[slot / 3].edges[slot % 3]; }
  double lengthAt(int slot) const { return faces[slot / 3].opposite[slot % 3]; }
  Eigen::Vector3d middleOf(int edge) const {
    const int side = edge_slots[edge_offset[edge]];
    return positions[vertexAt(nextSide(side))] / 2 + positions[vertexAt(previousSide(side))] / 2;
  }
  bool isLoop(int side) const { return vertexAt(nextSide(side)) == vertexAt(previousSide(side)); }
  /// Which end of an edge from a vertex to itself a corner of its side is; 0 on other edges.
  int endAt(int side, int corner) const {
    return !isLoop(side) ? 0 : corner == nextSide(side) ? loop_end[side] : 1 - loop_end[side];
  }
  std::size_t bytes() const;
};

/// The slot of a face that two others leave.
constexpr int thirdSlot(int a, int b) {
  return a / 3 * 3 + (3 - a % 3 - b % 3);
}

/// @param faces distinct ones with corners in [0, vertices)
/// @param exponent of the unit in which lengths are kept: they are divided by 2^exponent
/// @param split how often a march is to cut each face into four: the last time it does so itself, and before that they
/// are stored. The middle of edge e of the faces before is the vertex `vertices + e`.
/// @param positions of each vertex, in the caller's unit; none: they are not known
MarchFaces marchFaces(const std::vector<DistinctFace>& faces, int vertices, int exponent, int split,
                      const Workers& workers, const Points& positions = {});
/// Those of a cover.
/// @param number of each vertex in the result, a permutation; empty: as in the cover
/// @param positions of each vertex of the cover, in the caller's unit; none: they are not known
MarchFaces marchFaces(const IntrinsicTriangulation& cover, int split, const Workers& workers,
                      const std::vector<int>& number = {}, const Points& positions = {});

/// A position in units of 2^exponent.
inline Eigen::Vector3d scaledPosition(const Eigen::RowVector3d& position, int exponent) {
  return {std::ldexp(position.x(), -exponent), std::ldexp(position.y(), -exponent),
          std::ldexp(position.z(), -exponent)};
}

/// Tells the ends of sides from a vertex to itself by how the cover is glued. Flips leave them behind at rims, where
/// their halves lie on the front and on the back, and around necks.
/// @param faces those of the cover, with its numbers and not cut
void setLoopEnds(const IntrinsicTriangulation& cover, MarchFaces& faces);

/// Numbers the vertices of a cover in the order in which its faces name them. Clouds have theirs along a curve, so
/// neighbours get numbers, and places in memory, near each other.
std::vector<int> numbersByFaces(const IntrinsicTriangulation& cover);

/// How often to cut the faces: as the caller says or, where he does not, as DistanceOptions::split.
/// @param function how messages call the function that was asked
/// @throws InvalidInput for a split outside [0, 2]
int checkedSplit(const std::string& function, std::optional<int> split, const Laplacian& laplacian);

}  // namespace tufted
