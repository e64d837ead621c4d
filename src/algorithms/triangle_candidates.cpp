#include "algorithms/triangle_candidates.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "operators/distinct_faces.h"

namespace tufted {

double circumradius(const Eigen::RowVector3d& a, const Eigen::RowVector3d& b, const Eigen::RowVector3d& c) {
  const double ab = (b - a).stableNorm(), bc = (c - b).stableNorm(), ca = (a - c).stableNorm();
  const double longest = std::max({ab, bc, ca});
  if (!(longest > 0)) return std::numeric_limits<double>::infinity();
  const double twice_area = ((b - a) / longest).cross((c - a) / longest).norm();
  return longest * (ab / longest) * (bc / longest) * (ca / longest) / (2 * twice_area);
}

std::vector<TriangleCandidate> triangleCandidates(const Laplacian& laplacian, const Workers& workers) {
  const std::vector<DistinctFace> faces =
      distinctFaces(*laplacian.cover_source, static_cast<int>(laplacian.status.size()), workers);
  double unit = 0;  // longest side of the cover
  for (const DistinctFace& face : faces)
    unit = std::max(unit, *std::max_element(face.opposite.begin(), face.opposite.end()));
  const Points& positions = laplacian.positions;
  std::vector<TriangleCandidate> candidates;
  for (const auto& [corners, opposite, copies] : faces) {
    const auto [a, b, c] = corners;
    if (a == b || b == c) continue;
    if (!candidates.empty() && candidates.back().corners == corners) {
      candidates.back().faces += copies;  // their sides differ, if only by rounding
      continue;
    }
    const double radius = circumradius(positions.row(a), positions.row(b), positions.row(c)) / unit;
    candidates.push_back({corners, copies, static_cast<float>(radius)});
  }
  return candidates;
}

}  // namespace tufted
