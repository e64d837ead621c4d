#include "stars/boundary.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "stars/gaps.h"
#include "stars/tangent_frame.h"

namespace tufted {
namespace {

/// Points beyond a gap are searched among this many times k neighbours, the greatest growth of a neighbourhood.
constexpr int search_factor = 8;
constexpr double off_plane = 0.25;  // share of the fit radius, as between the heights of two sheets
/// Bound on the coordinates of a viewpoint, in median spreads, since their squares must fit a double.
constexpr double far_away = 1e70;

enum class View { along_normal, from_viewpoint };

/// The points around p, projected to a plane.
class TangentPlane {
 public:
  TangentPlane(const PointsView& positions, int p, const Eigen::Vector3d& normal)
      : positions_(positions), p_(p), x_(tangentOf(normal)), y_(normal.cross(x_)) {}

  /// The projected vector from p to q.
  Eigen::Vector2d offset(int q) const {
    const Eigen::Vector3d d = positions_.row(q) - positions_.row(p_);
    return {d.dot(x_), d.dot(y_)};
  }
  double direction(int q) const {
    const Eigen::Vector2d d = offset(q);
    return std::atan2(d.y(), d.x());
  }

 private:
  PointsView positions_;
  int p_;
  Eigen::Vector3d x_, y_;
};

struct BoundaryWorker {
  SearchBefore before, seen_before;
  Buffer<Gap> gaps;
  Buffer<Neighbor> near;
};

/// Classifies what lies beyond the gaps of a star.
class BoundaryFinder {
 public:
  BoundaryFinder(BuiltStars& built, const PointsView& points, const NeighborSource& source)
      : stars_(built.stars), support_(built.support), points_(points), source_(source) {}

  /// find() tests gaps in the image seen from `viewpoint`, too.
  void lookFrom(const Eigen::Vector3d& viewpoint, const Workers& workers) {
    directions_.resize(points_.rows());
    workers.forBlocks("boundary", points_.rows(), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
      for (std::int64_t p = begin; p < end; ++p)
        directions_.row(p) = (points_.row(p) - viewpoint.transpose()).normalized();
    });
    seen_.emplace(directions_, workers);
  }

  Boundary find(int p, BoundaryWorker& state) const {
    if (stars_.ends[p] == 0) return Boundary::none;
    if (!hasTriangles(stars_, p)) return Boundary::lost;
    source_.nearest(points_, p, search_factor * source_.k, state.near, NeighborOrder::any, &state.before);
    if (source_.search != nullptr) support_.boundary_reach[p] = state.before.radius;
    const Eigen::Vector3d normal = support_.normals.row(p);
    const Boundary along_normal = lookBeyond(p, View::along_normal, TangentPlane(points_, p, normal), state);
    if (!seen_ || along_normal == Boundary::jump) return along_normal;

    const Eigen::Vector3d sight = directions_.row(p);
    seen_->nearest(p, search_factor * source_.k, state.near, NeighborOrder::any, &state.seen_before);
    const TangentPlane image(directions_, p, sight.dot(normal) < 0 ? -sight : sight);  // keeps gaps counterclockwise
    const Boundary in_image = lookBeyond(p, View::from_viewpoint, image, state);
    return in_image == Boundary::jump ? Boundary::jump : along_normal;
  }

 private:
  /// Squared length of the longest projected spoke of a star that has triangles.
  double longestEdge(int p, const TangentPlane& plane) const {
    double longest = 0;
    forEachTriangle(stars_, p, [&](int a, int b) {
      longest = std::max({longest, plane.offset(a).squaredNorm(), plane.offset(b).squaredNorm()});
    });
    return longest;
  }

  /// Whether q is too far off the tangent plane of p to lie on the same surface. Along the normal, a surface may bend
  /// away with distance; what a viewpoint sees beside p is near p or elsewhere.
  bool isElsewhere(int p, int q, View view) const {
    const Eigen::RowVector3d d = points_.row(q) - points_.row(p);
    const double height = std::abs(d.dot(support_.normals.row(p)));
    const double along = std::sqrt(std::max(0.0, d.squaredNorm() - height * height));
    return height >
           off_plane * (view == View::along_normal ? std::max(support_.fit_radius[p], along) : support_.fit_radius[p]);
  }

  Boundary lookBeyond(int p, View view, const TangentPlane& plane, BoundaryWorker& state) const {
    findGaps(
        stars_, p, [&](int q) { return plane.direction(q); }, state.gaps);
    const double limit = farthest_beyond * farthest_beyond * longestEdge(p, plane);
    bool is_rim = false;
    for (const Gap& gap : state.gaps) {
      bool goes_on = false;
      for (const Neighbor& q : state.near) {
        const Eigen::Vector2d offset = plane.offset(q.index);
        const double distance = offset.squaredNorm();
        if (!(distance > 0 && distance <= limit)) continue;
        if (!gap.holdsInTheMiddle(std::atan2(offset.y(), offset.x())) || !hasTriangles(stars_, q.index)) continue;
        if (isElsewhere(p, q.index, view)) return Boundary::jump;
        goes_on = true;
      }
      if (!goes_on) is_rim = true;
    }
    return is_rim ? Boundary::rim : Boundary::lost;
  }

  const Stars& stars_;
  StarSupport& support_;
  PointsView points_;
  const NeighborSource& source_;
  PointBuffer directions_;  ///< n x 3, unit vectors from the viewpoint; 0 x 3 without one
  std::optional<NeighborSearch> seen_;
};

}  // namespace

Buffer<Boundary> findBoundary(BuiltStars& built, const RankedCloud& cloud, const NeighborSource& source,
                              const Eigen::Vector3d* viewpoint, const Workers& workers) {
  const Stars& stars = built.stars;
  Buffer<Boundary> boundary(stars.size(), Boundary::none);
  built.support.boundary_reach.assign(stars.size(), 0);
  BoundaryFinder finder(built, cloud.points, source);
  const auto scaled = [&](double x) { return std::clamp(std::ldexp(x, -cloud.exponent), -far_away, far_away); };
  const bool any = std::any_of(stars.ends.begin(), stars.ends.end(), [](std::uint8_t ends) { return ends != 0; });
  if (any && viewpoint != nullptr) finder.lookFrom(viewpoint->unaryExpr(scaled), workers);
  Buffer<BoundaryWorker> states(workers.count());
  workers.forBlocks("boundary", stars.size(), usual_block, [&](std::int64_t begin, std::int64_t end, int worker) {
    for (int p = static_cast<int>(begin); p < end; ++p) boundary[p] = finder.find(p, states[worker]);
  });
  return boundary;
}

}  // namespace tufted
