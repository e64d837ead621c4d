#pragma once

#include <array>
#include <vector>

#include "base/parallel.h"
#include "tufted/intrinsic_triangulation.h"

namespace tufted {

/// A face of a cover with its corners ascending, so that faces of the same corners and lengths compare equal whichever
/// way they run.
struct DistinctFace {
  std::array<int, 3> corners;
  std::array<double, 3> opposite;  ///< length of the side opposite each corner
  int copies = 1;                  ///< how many faces of the cover are this one

  friend bool operator<(const DistinctFace& a, const DistinctFace& b) {
    return a.corners != b.corners ? a.corners < b.corners : a.opposite < b.opposite;
  }
  bool isCopyOf(const DistinctFace& other) const { return corners == other.corners && opposite == other.opposite; }
};

/// One copy of a face.
/// @param corners,opposite in any order, the same in both
DistinctFace distinctFace(const std::array<int, 3>& corners, const std::array<double, 3>& opposite);
/// Face number `face` of a cover, as one copy.
/// @param number that corners have in the result; empty: as in the cover
DistinctFace distinctFace(const IntrinsicTriangulation& cover, int face, const std::vector<int>& number = {});

/// Sorts faces and merges equal ones.
void mergeCopies(std::vector<DistinctFace>& faces);

/// The distinct faces of a cover (front and back, and the copies that clouds find of each triangle, are one), sorted.
/// @param number of each vertex in the result, a permutation; empty: as in the cover
std::vector<DistinctFace> distinctFaces(const IntrinsicTriangulation& cover, const Workers& workers,
                                        const std::vector<int>& number = {});

/// A power of two near the mean of these lengths, as its exponent; 0 if none is positive or one is not finite.
int unitOf(const std::vector<double>& lengths);

}  // namespace tufted
