#include "support/compare_stars.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "neighbors/neighbors.h"
#include "oracles/oracles.h"
#include "stars/delaunay_star.h"
#include "stars/tangent_frame.h"
#include "support/ranked.h"

namespace tufted::support {
namespace {

Buffer<PlanarPoint> project(const RankedCloud& cloud, int p, const Buffer<Neighbor>& neighbors) {
  const Eigen::Vector3d normal = principalAxes(cloud.points, p, neighbors).normal;
  const Eigen::Vector3d x = tangentOf(normal), y = normal.cross(x);
  Buffer<PlanarPoint> planar;
  for (const Neighbor& q : neighbors) {
    const Eigen::Vector3d d = (cloud.points.row(q.index) - cloud.points.row(p)).transpose();
    planar.push_back({d.dot(x), d.dot(y), q.index});
  }
  return planar;
}

std::set<int> linkOf(const DelaunayStar& star) {
  std::set<int> link;
  if (star.triangles() == 0) return link;
  for (const PlanarPoint& q : star.link) link.insert(q.index);
  return link;
}

/// Whether the star's point, q and two points of `ring` beside q are cocircular within the tie band, so that both
/// diagonals are right.
bool isTied(const PlanarPoint& q, const Buffer<PlanarPoint>& ring) {
  for (const PlanarPoint& a : ring) {
    for (const PlanarPoint& c : ring) {
      if (a.index == q.index || c.index == q.index || orientation(a, q) <= 0 || orientation(q, c) <= 0) continue;
      if (orientation(a, c) > 0 && sideOfCircle(a, q, c) == CircleSide::tie) return true;
    }
  }
  return false;
}

}  // namespace

StarComparison compareStars(const Points& points, int step) {
  const RankedCloud cloud = support::ranked(points);
  const NeighborSearch search(cloud.points);
  Buffer<Neighbor> neighbors;
  StarScratch scratch;
  DelaunayStar ours, backend;
  StarComparison result;
  for (int p = 0; p < cloud.size(); p += step) {
    search.nearest(p, 30, neighbors);
    const Buffer<PlanarPoint> planar = project(cloud, p, neighbors);
    Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> plane(planar.size(), 2);
    for (std::size_t i = 0; i < planar.size(); ++i) plane.row(i) << planar[i].u, planar[i].v;
    const oracles::PlanarStar oracle = oracles::delaunayStarOracle(plane);
    delaunayStar(planar, p, scratch, ours);
    ++result.stars;

    std::set<int> oracle_link;
    for (const auto& [a, b] : oracle.triangles) oracle_link.insert({planar[a].index, planar[b].index});
    const std::set<int> our_link = linkOf(ours);
    bool tied = false, different = ours.triangles() > 0 && ours.closed != oracle.closed;
    const auto compareWith = [&](const std::set<int>& link) {
      Buffer<PlanarPoint> ring;  // the points of both links
      for (const PlanarPoint& q : planar) {
        if (our_link.count(q.index) + link.count(q.index) > 0) ring.push_back(q);
      }
      for (const PlanarPoint& q : ring) {
        if (our_link.count(q.index) != link.count(q.index)) (isTied(q, ring) ? tied : different) = true;
      }
    };
    compareWith(oracle_link);
#ifdef TUFTED_WITH_GPL
    delaunayStarCgal(planar, p, scratch, backend);
    compareWith(linkOf(backend));
#endif
    result.with_ties += tied ? 1 : 0;
    result.different += different ? 1 : 0;
    if (different && result.first_difference.empty()) {
      result.first_difference = "point " + std::to_string(cloud.input_index[p]) + ": our link has " +
                                std::to_string(our_link.size()) + " vertices, CGAL's " +
                                std::to_string(oracle_link.size());
    }
  }
  return result;
}

}  // namespace tufted::support
