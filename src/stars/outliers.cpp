#include "stars/outliers.h"

#include <algorithm>
#include <cmath>

#include "base/buffer.h"
#include "base/point_buffer.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 1024;
constexpr double steep = 0.5;  // sine of the angle between a tangent plane and the way to a point

/// Whether p lies beyond the neighbours that q looked at.
bool isUnseen(const Stars& stars, const PointsView& points, int p, int q) {
  return (points.row(p) - points.row(q)).squaredNorm() > stars.fit_radius[q] * stars.fit_radius[q];
}

/// Whether p lies far off the tangent plane of q, for its distance.
bool isOffPlane(const Stars& stars, const PointsView& points, int p, int q) {
  const Eigen::RowVector3d d = points.row(p) - points.row(q);
  const double height = std::abs(d.dot(stars.normals.row(q)));
  return height > steep * d.norm();
}

/// Whether the star alone allows p to be an outlier. Next to all points are spared the search.
/// @param is_known what was isolated since then is all that could have changed
bool isSuspect(const Stars& stars, const PointsView& points, int p, bool is_known) {
  const auto begin = stars.link.begin() + stars.offset[p], end = stars.link.begin() + stars.offset[p + 1];
  return std::any_of(begin, end,
                     [&](int q) { return stars.isolated[q] != 0 || (!is_known && isUnseen(stars, points, p, q)); });
}

bool isOutlier(const Stars& stars, const PointsView& points, int p, const Buffer<Neighbor>& neighbors) {
  const auto hovered = std::count_if(neighbors.begin(), neighbors.end(), [&](const Neighbor& q) {
    return isUnseen(stars, points, p, q.index) && isOffPlane(stars, points, p, q.index);
  });
  return 2 * hovered > static_cast<std::ptrdiff_t>(neighbors.size());
}

/// Leaves the point without a triangle. Returns how many it loses.
int isolate(Stars& stars, int p) {
  int dropped = 0;
  stars.isolated[p] = stars.ends[p] = 1;
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
    dropped += stars.hasTriangle(i) ? 1 : 0;
    stars.triangle[i] = 0;
  }
  return dropped;
}

}  // namespace

void isolateOutliers(Stars& stars, const RankedCloud& cloud, const NeighborSource& source, const Workers& workers,
                     Report& report) {
  if (source.search == nullptr) return;
  enum Verdict : std::uint8_t { untried, sound, outlier, isolated };
  Buffer<Verdict> verdicts(stars.size(), untried);
  // Outliers that see each other alone become suspect once one of them is isolated.
  bool found = true;
  for (int round = 0; found; ++round) {
    found = false;
    workers.forBlocks("outliers", stars.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
      Buffer<Neighbor> neighbors;
      for (int p = static_cast<int>(begin); p < end; ++p) {
        if (verdicts[p] != untried || !isSuspect(stars, cloud.points, p, round > 0)) continue;
        source.nearest(cloud.points, p, source.k, neighbors);
        verdicts[p] = isOutlier(stars, cloud.points, p, neighbors) ? outlier : sound;
      }
    });
    for (int p = 0; p < stars.size(); ++p) {
      if (verdicts[p] != outlier) continue;
      verdicts[p] = isolated;
      report.dropped_triangles += isolate(stars, p);
      ++report.outliers;
      found = true;
    }
  }
}

}  // namespace tufted
