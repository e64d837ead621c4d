#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/types.h"

namespace tufted {

/// Triangles joined by edges, consistently oriented if possible (docs/algorithm.md, section 24).
struct Chart {
  std::vector<std::array<int, 3>> triangles;  ///< corners are points
  /// Boundary curves, each a closed sequence of points in the direction of the triangles' sides. At a point where
  /// several fans meet, each fan has a curve of its own.
  std::vector<std::vector<int>> rims;
  int vertices = 0;  ///< number of different points
  int edges = 0;
  bool is_manifold = true;    ///< no edge has more than two triangles
  bool is_orientable = true;  ///< no edge has the same direction in both of its triangles

  /// V - E + F.
  int eulerCharacteristic() const { return vertices - edges + static_cast<int>(triangles.size()); }
};

/// The usable triangles, with corners replaced by their representatives. Left out are those with a repeated corner or
/// one that is not active, and of those with the same corners all but the first.
/// @throws InvalidInput for an index out of range, in the name of `function`
std::vector<std::array<int, 3>> usableTriangles(const char* function, const Laplacian& laplacian,
                                                const TrianglesRef& triangles);

/// The charts of usableTriangles(), those of more triangles first.
/// @param cut if given, charts of a cloud are cut where orientations do not agree, as single wrong triangles may cause;
/// gets the number of triangles left out for that
/// @throws InvalidInput for an index out of range, in the name of `function`
std::vector<Chart> findCharts(const char* function, const Laplacian& laplacian, const TrianglesRef& triangles,
                              std::int64_t* cut = nullptr);

}  // namespace tufted
