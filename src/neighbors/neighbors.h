#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "neighbors/kd_forest.h"
#include "tufted/types.h"

namespace tufted {

struct Neighbor {
  double squared_distance;
  int index;  ///< rank

  friend bool operator<(const Neighbor& a, const Neighbor& b) {
    return a.squared_distance < b.squared_distance || (a.squared_distance == b.squared_distance && a.index < b.index);
  }
};

/// Squared distances of FLANN and ours differ by less than this part.
constexpr double distance_rounding = 1e-12;

/// A bound on squared distances that holds however they were rounded.
inline double widened(double squared_distance) {
  return squared_distance * (1 + distance_rounding) + std::numeric_limits<double>::denorm_min();
}

/// The least squared distance that bounds others; smaller ones have no digits left.
constexpr double least_square = 1e-290;

enum class NeighborOrder { ascending, any };

/// What the search before has found, which bounds that for a point near by.
struct SearchBefore {
  int p = 0, k = 0;   ///< k = 0: there was none
  double radius = 0;  ///< of the k nearest of p
};

/// Points that are searched around together.
struct PointGroup {
  int first;                  ///< rank of one of them
  int middle;                 ///< rank of one in their midst
  Eigen::RowVector3d center;  ///< of their box
  double spread;              ///< how far from there the farthest of them is
};

/// Where NeighborSearch::candidates has looked.
struct SearchedBall {
  Eigen::RowVector3d center;
  double radius = 0;    ///< every point within is a candidate
  double k_radius = 0;  ///< a point q of the group has at least k neighbours within k_radius + distance(q, center)
};

/// Exact nearest neighbours among all points.
class NeighborSearch : public InWorkspace {
 public:
  /// How many candidates there may be of k nearest: what stays in cache, but more where a few points have as many.
  static constexpr int mostCandidates(int k) { return std::max(1024, 8 * k); }

  /// @param points n x 3, distinct, finite, in Morton order; borrowed for the life of the search
  NeighborSearch(const PointsView& points, const Workers& workers);
  /// Built by the calling thread alone.
  explicit NeighborSearch(const PointsView& points);
  ~NeighborSearch();
  NeighborSearch(const NeighborSearch&) = delete;
  NeighborSearch& operator=(const NeighborSearch&) = delete;

  /// The min(k, n - 1) points nearest to point p, itself left out by index: the least by (distance, index),
  /// the largest of them last. `found` is overwritten and keeps its memory. Safe to call from several threads.
  /// @param before overwritten; null: the search takes somewhat longer
  void nearest(int p, int k, Buffer<Neighbor>& found, NeighborOrder order = NeighborOrder::ascending,
               SearchBefore* before = nullptr) const;

  /// All points that may be the nearest to a position: those whose squared distance is the least, and others within
  /// its rounding. None where the squares overflow. Points need neither be distinct nor in Morton order for this.
  /// @param[out] found in no order
  void nearestTo(const Eigen::RowVector3d& position, Buffer<Neighbor>& found) const;

  /// All points that any of a group has among its min(k, n - 1) nearest, and others near them. False, and nothing of
  /// use, where these are more than mostCandidates(k), or so close that squares of their distances underflow.
  /// @param[out] found ranks
  /// @param bounds scratch
  /// @param[out] ball around the group
  bool candidates(const PointGroup& group, int k, Buffer<int>& found, Buffer<double>& bounds, SearchedBall& ball) const;

  /// All points within `around` of any of a group, and others near them. False, and nothing of use, where these are too
  /// many for k nearest or too close, as for candidates().
  /// @param[out] ball its k_radius is not known
  bool candidatesWithin(const PointGroup& group, int k, double around, Buffer<int>& found, SearchedBall& ball) const;

  std::size_t bytes() const;

 private:
  std::unique_ptr<KdForest> forest_;  ///< null with fewer than two points
  PointsView points_;
};

}  // namespace tufted
