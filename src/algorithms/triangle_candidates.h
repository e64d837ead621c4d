#pragma once

#include <array>
#include <vector>

#include "base/parallel.h"
#include "tufted/laplacian.h"

namespace tufted {

/// A triangle of a cover, in any orientation.
struct TriangleCandidate {
  std::array<int, 3> corners;  ///< ascending
  int faces;                   ///< number of faces of the cover with these corners: two for each star
  float radius;                ///< circumradius over the longest side of the cover
};

/// The distinct triples of different corners of the faces of the cover, ascending.
/// @param laplacian with a cover, and with finite positions
std::vector<TriangleCandidate> triangleCandidates(const Laplacian& laplacian, const Workers& workers);

/// The radius of the circle through three points; infinite if they lie on a line.
double circumradius(const Eigen::RowVector3d& a, const Eigen::RowVector3d& b, const Eigen::RowVector3d& c);

}  // namespace tufted
