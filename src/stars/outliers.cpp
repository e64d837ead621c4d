#include "stars/outliers.h"

#include <algorithm>
#include <cmath>

#include "base/buffer.h"
#include "base/point_buffer.h"

namespace tufted {
namespace {

/// A point hovers over a tangent plane if the sine of its angle to the plane exceeds this; a curved surface stays below
/// within its neighbourhood.
constexpr double steep = 0.5;

/// Whether p lies beyond the fit radius of q.
bool isUnseen(const StarSupport& support, const PointsView& points, int p, int q) {
  return (points.row(p) - points.row(q)).squaredNorm() > support.fit_radius[q] * support.fit_radius[q];
}

/// Whether p is far off the tangent plane of q, relative to its distance.
bool isOffPlane(const StarSupport& support, const PointsView& points, int p, int q) {
  const Eigen::RowVector3d d = points.row(p) - points.row(q);
  const double height = std::abs(d.dot(support.normals.row(q)));
  return height > steep * d.norm();
}

/// Whether p may be an outlier, judged by its star without a search; nearly all points are not.
/// @param is_known p was tested before; only newly isolated points change the answer
bool isSuspect(const BuiltStars& built, const PointsView& points, int p, bool is_known) {
  const auto& [stars, support] = built;
  const auto begin = stars.link.begin() + stars.offset[p], end = stars.link.begin() + stars.offset[p + 1];
  for (auto q = begin; q != end; ++q)
    if (support.isolated[*q] != 0 || (!is_known && isUnseen(support, points, p, *q))) return true;
  return false;
}

bool isOutlier(const StarSupport& support, const PointsView& points, int p, const Buffer<Neighbor>& neighbors) {
  const auto hovered = std::count_if(neighbors.begin(), neighbors.end(), [&](const Neighbor& q) {
    return isUnseen(support, points, p, q.index) && isOffPlane(support, points, p, q.index);
  });
  return 2 * hovered > static_cast<std::ptrdiff_t>(neighbors.size());
}

/// Removes all triangles of the star of p and returns their number.
int isolate(BuiltStars& built, int p) {
  Stars& stars = built.stars;
  int dropped = 0;
  built.support.isolated[p] = stars.ends[p] = 1;
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
    dropped += stars.hasTriangle(i) ? 1 : 0;
    stars.triangle[i] = 0;
  }
  return dropped;
}

}  // namespace

void isolateOutliers(BuiltStars& built, const RankedCloud& cloud, const NeighborSource& source, const Workers& workers,
                     Report& report) {
  if (source.search == nullptr) return;
  const Stars& stars = built.stars;
  enum Verdict : std::uint8_t { untried, sound, outlier, isolated };
  Buffer<Verdict> verdicts(stars.size(), untried);
  // A group of outliers that see each other is found one round after the other.
  bool found = true;
  for (int round = 0; found; ++round) {
    found = false;
    workers.forBlocks("outliers", stars.size(), star_block, [&](std::int64_t begin, std::int64_t end, int) {
      Buffer<Neighbor> neighbors;
      for (int p = static_cast<int>(begin); p < end; ++p) {
        if (verdicts[p] != untried || !isSuspect(built, cloud.points, p, round > 0)) continue;
        source.nearest(cloud.points, p, source.k, neighbors);
        verdicts[p] = isOutlier(built.support, cloud.points, p, neighbors) ? outlier : sound;
      }
    });
    for (int p = 0; p < stars.size(); ++p) {
      if (verdicts[p] != outlier) continue;
      verdicts[p] = isolated;
      report.dropped_triangles += isolate(built, p);
      ++report.outliers;
      found = true;
    }
  }
}

}  // namespace tufted
