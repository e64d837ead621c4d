#pragma once

#include <cstddef>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "neighbors/morton.h"
#include "neighbors/neighbors.h"
#include "neighbors/scan/ranked_scan.h"

namespace tufted {

/// Neighbours in the scan of a spinning scanner, without a tree: those on the own ring and on those beside it.
///
/// Distances along a ring are often a tenth to a hundredth of those between rings: a ball that reaches a few rings
/// holds thousands of points, nearly all of them on p's own ring and of no use. Of each ring those nearest to p count,
/// for an empty circle through p that misses its neighbours on the ring meets other rings nowhere else; of the others
/// every second, every fourth and so on tell the plane. A ring that is too far hides those behind it.
class RingSearch : public InWorkspace {
 public:
  RingSearch(const RankedScan& scan, const RankedCloud& cloud);

  /// About k points around p, itself left out, ascending by (distance, index); fewer where the scan holds no more.
  /// They get sparser with their distance, so that they are crowded in the middle. `found` is overwritten and keeps its
  /// memory. Safe to call from several threads.
  /// @returns the radius of the ball that was searched, short of points that a ring's own hide
  double nearest(int p, int k, Buffer<Neighbor>& found) const;

  std::size_t bytes() const;

 private:
  int ringSize(int ring) const { return begin_[ring + 1] - begin_[ring]; }

  /// So many points further around the ring; -1 where that is the point itself.
  int stepped(int place, int steps) const;
  double squaredDistance(int a, int b) const { return (points_.row(a) - points_.row(b)).squaredNorm(); }
  double distanceTo(int a, int b) const;
  /// A point of the ring that is nearer to `self` than those around it, sought from the azimuth of `from`; -1 if there
  /// is no such ring.
  int footOn(int ring, int self, int from) const;
  /// Adds the points of a ring around `foot` that lie in the ball around `self`.
  void addRing(int self, int foot, double radius, Buffer<Neighbor>& found) const;

  Buffer<int> place_;       ///< of each rank in the order of rings and azimuths, -1: none
  Buffer<int> rank_;        ///< the inverse
  Buffer<int> ring_;        ///< by place
  Buffer<double> azimuth_;  ///< by place
  Buffer<int> begin_;       ///< first place of each ring; number of places at the end
  PointBuffer points_;      ///< by place
};

}  // namespace tufted
