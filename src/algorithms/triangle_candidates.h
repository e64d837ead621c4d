#pragma once

#include <array>
#include <vector>

#include "tufted/intrinsic_triangulation.h"
#include "tufted/types.h"

namespace tufted {

/// A triangle of a cover, whichever way its faces run.
struct TriangleCandidate {
  std::array<int, 3> corners;  ///< ascending
  int faces;                   ///< how many faces of the cover have these corners: two for each star
  float radius;                ///< of the circumscribed circle, over the root mean squared side of all
};

/// The distinct triangles with three different corners in a cover, by ascending corners.
/// @param positions of the corners, finite
std::vector<TriangleCandidate> triangleCandidates(const IntrinsicTriangulation& cover, const Points& positions);

/// The radius of the circle through three points; infinite if they lie on a line.
double circumradius(const Eigen::RowVector3d& a, const Eigen::RowVector3d& b, const Eigen::RowVector3d& c);

}  // namespace tufted
