#pragma once

#include <array>
#include <vector>

#include "base/cover_source.h"
#include "base/parallel.h"

namespace tufted {

/// A face of a cover with its corners ascending, so that faces with the same corners and lengths are equal in any
/// orientation.
struct DistinctFace {
  std::array<int, 3> corners;
  std::array<double, 3> opposite;  ///< length of the side opposite each corner
  int copies = 1;                  ///< number of faces of the cover that are equal to this one

  /// Whether both have the same corners. Comparing the arrays calls memcmp(), which took a tenth of the set-up of a
  /// march.
  bool hasCornersOf(const DistinctFace& other) const {
    return corners[0] == other.corners[0] && corners[1] == other.corners[1] && corners[2] == other.corners[2];
  }
  bool isCopyOf(const DistinctFace& other) const { return hasCornersOf(other) && opposite == other.opposite; }
  friend bool operator<(const DistinctFace& a, const DistinctFace& b) {
    return a.hasCornersOf(b) ? a.opposite < b.opposite : a.corners < b.corners;
  }
};

/// One copy of a face.
/// @param corners,opposite in the same order, any
DistinctFace distinctFace(const std::array<int, 3>& corners, const std::array<double, 3>& opposite);

/// Sorts faces and merges equal ones.
void mergeCopies(std::vector<DistinctFace>& faces);

/// The distinct faces of a cover (front and back, and the copies that clouds find of each triangle, are one), sorted.
/// @param number new number of each vertex, a permutation; empty: unchanged
std::vector<DistinctFace> distinctFaces(const CoverSource& cover, int vertices, const Workers& workers,
                                        const std::vector<int>& number = {});

/// The exponent of a power of two near the mean length; 0 if none is positive or one is not finite.
int unitOf(const CoverSource& cover);
int unitOf(const std::vector<DistinctFace>& faces);

}  // namespace tufted
