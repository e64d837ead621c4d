#pragma once

#include <flann/util/result_set.h>

#include <cstddef>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"

namespace tufted {

/// Collects the points that a KdForest finds: all that are nearer than worstDist(), and possibly others.
class RankSet : public flann::ResultSet<double> {
 protected:
  /// @param index the argument of addPoint()
  int rankOf(std::size_t index) const { return first_ + static_cast<int>(index); }

 private:
  friend class KdForest;
  int first_ = 0;
};

/// FLANN's KDTreeSingleIndex in double over consecutive points: one tree, or several built by as many threads.
///
/// The number of trees changes the order in which points are found, and which points beyond the last worstDist() are.
class KdForest : public InWorkspace {
 public:
  /// @param points n x 3, n > 0; borrowed for the life of the forest
  KdForest(const PointsView& points, const Workers& workers);
  ~KdForest();
  KdForest(const KdForest&) = delete;
  KdForest& operator=(const KdForest&) = delete;

  /// Shows all points nearer to `position` than found.worstDist(), which may shrink meanwhile.
  /// @param position 3 coordinates
  /// @param near_rank a point near `position`, whose tree is searched first, which bounds the search of the others
  void search(const double* position, int near_rank, RankSet& found) const;

  std::size_t bytes() const;

 private:
  struct Tree;
  void search(const Tree& tree, const double* position, RankSet& found) const;
  int size_;
  Buffer<Tree> trees_;
};

}  // namespace tufted
