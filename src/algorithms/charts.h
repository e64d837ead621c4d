#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/types.h"

namespace tufted {

/// Triangles that edges join, oriented alike where that can be.
struct Chart {
  std::vector<std::array<int, 3>> triangles;  ///< corners are points
  /// Closed curves in which it ends, each by the points in the order in which the triangles run their sides. Around a
  /// point where several fans meet, each fan has its own.
  std::vector<std::vector<int>> rims;
  int vertices = 0;  ///< number of points that its triangles name
  int edges = 0;
  bool is_manifold = true;    ///< no edge has more than two triangles
  bool is_orientable = true;  ///< no edge is run twice in the same direction

  /// V - E + F.
  int eulerCharacteristic() const { return vertices - edges + static_cast<int>(triangles.size()); }
};

/// The triangles that take part, of representatives: those that name a point twice or one that is not active are left
/// out, and of those with the same corners all but the first.
/// @throws InvalidInput for an index out of range, in the name of `function`
std::vector<std::array<int, 3>> usableTriangles(const char* function, const Laplacian& laplacian,
                                                const TrianglesRef& triangles);

/// The charts of the usable triangles, those of more triangles first.
/// @param cut if given, charts of a cloud are cut where orientations meet that do not agree, as single wrong triangles
///        make them do: gets the number of triangles that are left out for that
/// @throws InvalidInput for an index out of range, in the name of `function`
std::vector<Chart> findCharts(const char* function, const Laplacian& laplacian, const TrianglesRef& triangles,
                              std::int64_t* cut = nullptr);

}  // namespace tufted
