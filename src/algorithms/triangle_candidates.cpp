#include "algorithms/triangle_candidates.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace tufted {

double circumradius(const Eigen::RowVector3d& a, const Eigen::RowVector3d& b, const Eigen::RowVector3d& c) {
  const double ab = (b - a).stableNorm(), bc = (c - b).stableNorm(), ca = (a - c).stableNorm();
  const double longest = std::max({ab, bc, ca});
  if (!(longest > 0)) return std::numeric_limits<double>::infinity();
  const double twice_area = ((b - a) / longest).cross((c - a) / longest).norm();
  return longest * (ab / longest) * (bc / longest) * (ca / longest) / (2 * twice_area);
}

std::vector<TriangleCandidate> triangleCandidates(const IntrinsicTriangulation& cover, const Points& positions) {
  using Corners = std::array<int, 3>;
  std::vector<std::int64_t> offset(static_cast<std::size_t>(cover.vertices) + 1, 0);
  const auto isWhole = [](const Corners& face) {
    return face[0] != face[1] && face[1] != face[2] && face[2] != face[0];
  };
  for (const Corners& face : cover.faces)
    if (isWhole(face)) ++offset[*std::min_element(face.begin(), face.end()) + 1];
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  std::vector<std::array<int, 2>> others(static_cast<std::size_t>(offset.back()));  // the two larger corners
  std::vector<std::int64_t> fill(offset.begin(), offset.end() - 1);
  for (Corners face : cover.faces) {
    if (!isWhole(face)) continue;
    std::sort(face.begin(), face.end());
    others[fill[face[0]]++] = {face[1], face[2]};
  }
  double unit = 0;  // longest side of the cover
  for (const double length : cover.length) unit = std::max(unit, length);
  std::vector<TriangleCandidate> candidates;
  candidates.reserve(others.size() / 4);
  for (int a = 0; a < cover.vertices; ++a) {
    const auto begin = others.begin() + offset[a], end = others.begin() + offset[a + 1];
    std::sort(begin, end);
    for (auto first = begin; first != end;) {
      const auto next = std::find_if(first, end, [&](const auto& other) { return other != *first; });
      const auto [b, c] = *first;
      const double radius = circumradius(positions.row(a), positions.row(b), positions.row(c)) / unit;
      candidates.push_back({{a, b, c}, static_cast<int>(next - first), static_cast<float>(radius)});
      first = next;
    }
  }
  return candidates;
}

}  // namespace tufted
