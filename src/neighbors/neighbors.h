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

/// Relative difference of squared distances of FLANN and ours at most.
constexpr double distance_rounding = 1e-12;

/// An upper bound on a squared distance however it was rounded.
inline double widened(double squared_distance) {
  return squared_distance * (1 + distance_rounding) + std::numeric_limits<double>::denorm_min();
}

/// The least squared distance that is used as a bound; smaller ones have lost their digits.
constexpr double least_square = 1e-290;

enum class NeighborOrder { ascending, any };

/// The result of a previous search, which bounds the search for a point nearby.
struct SearchBefore {
  int p = 0, k = 0;   ///< k = 0: there was no search
  double radius = 0;  ///< distance from p to its k-th neighbour
};

/// Points whose neighbours are searched together.
struct PointGroup {
  int first;                  ///< rank of one of them
  int middle;                 ///< rank of one in the middle of the group
  Eigen::RowVector3d center;  ///< centre of their bounding box
  double spread;              ///< distance from `center` to the farthest point of the group
};

/// The ball that NeighborSearch::candidates has searched.
struct SearchedBall {
  Eigen::RowVector3d center;
  double radius = 0;    ///< every point within is a candidate
  double k_radius = 0;  ///< a point q of the group has at least k neighbours within k_radius + distance(q, center)
};

/// Exact nearest neighbours among all points.
class NeighborSearch : public InWorkspace {
 public:
  /// Greatest number of candidates for the k nearest: what stays in cache, or more if k is large.
  static constexpr int mostCandidates(int k) { return std::max(1024, 8 * k); }

  /// @param points n x 3, distinct, finite, in Morton order; borrowed for the life of the search
  NeighborSearch(const PointsView& points, const Workers& workers);
  /// Builds the tree on the calling thread.
  explicit NeighborSearch(const PointsView& points);
  ~NeighborSearch();
  NeighborSearch(const NeighborSearch&) = delete;
  NeighborSearch& operator=(const NeighborSearch&) = delete;

  /// The min(k, n - 1) points nearest to point p, which is left out by its index: the least by (distance, index), the
  /// farthest last in either order. `found` is overwritten and keeps its memory. Safe to call from several threads.
  /// @param before a previous search nearby, overwritten by this one; null: the search takes longer
  void nearest(int p, int k, Buffer<Neighbor>& found, NeighborOrder order = NeighborOrder::ascending,
               SearchBefore* before = nullptr) const;

  /// All points that may be the nearest to a position: those with the least squared distance, and others within its
  /// rounding. Empty if the squares overflow. Points need neither be distinct nor in Morton order for this.
  /// @param[out] found in any order
  void nearestTo(const Eigen::RowVector3d& position, Buffer<Neighbor>& found) const;

  /// All points that any point of a group has among its min(k, n - 1) nearest, and others near them.
  /// @returns false if these are more than mostCandidates(k), or so close that squared distances underflow; the results
  /// are then meaningless
  /// @param[out] found ranks
  /// @param bounds scratch
  /// @param[out] ball all points in it are in `found`
  bool candidates(const PointGroup& group, int k, Buffer<int>& found, Buffer<double>& bounds, SearchedBall& ball) const;

  /// All points within the distance `around` of any point of a group, and others near them.
  /// @returns false as candidates() does
  /// @param[out] ball see candidates(); k_radius is not set
  bool candidatesWithin(const PointGroup& group, int k, double around, Buffer<int>& found, SearchedBall& ball) const;

  std::size_t bytes() const;

 private:
  std::unique_ptr<KdForest> forest_;  ///< null with fewer than two points
  PointsView points_;
};

}  // namespace tufted
