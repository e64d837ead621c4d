#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/parallel.h"
#include "operators/distinct_faces.h"

// The triangles that distances march over.

namespace tufted {

/// A triangle by its lengths. Side `k` lies opposite corner `k`.
struct MarchFace {
  std::array<int, 3> corners;
  std::array<int, 3> edges;        ///< the edge that each side is
  std::array<double, 3> opposite;  ///< length of each side
  double double_area;              ///< base times height
};

/// Triangles with their edges, and which of them meet at a vertex or an edge. Any number may meet. A slot is a corner
/// of a face and the side opposite it, 3 face + corner. Faces without area stay, as edges lead along them.
struct MarchFaces {
  int vertices = 0;
  int edges = 0;     ///< sides with the same ends and length are one edge
  int exponent = 0;  ///< lengths are in units of 2^exponent of the caller's
  std::vector<MarchFace> faces;
  std::vector<int> corner_offset, corner_slots;  ///< vertices + 1; slots by the vertex at their corner
  std::vector<int> edge_offset, edge_slots;      ///< edges + 1; slots by the edge of their side

  std::size_t bytes() const;
};

/// @param faces distinct ones with corners in [0, vertices)
/// @param exponent of the unit in which lengths are kept: they are divided by 2^exponent
MarchFaces marchFaces(const std::vector<DistinctFace>& faces, int vertices, int exponent, const Workers& workers);

/// Every face cut into four at the middle of its sides. The middle of edge e is the vertex `vertices + e`.
MarchFaces splitInFour(const MarchFaces& coarse, const Workers& workers);

}  // namespace tufted
