#pragma once

#include <cstddef>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "neighbors/morton.h"
#include "neighbors/neighbors.h"
#include "neighbors/scan/ranked_scan.h"

namespace tufted {

/// Neighbours in the scan of a spinning scanner, on the own ring and those beside it, without a tree (*Rows of a scan*
/// in section 2 of docs/algorithm.md).
///
/// Distances along a ring are often a tenth to a hundredth of those between rings: a ball that reaches a few rings
/// holds thousands of points, nearly all on p's own ring and of no use. For the star the nearest points of each ring
/// suffice, because an empty circle through p that misses its neighbours on the ring meets other rings nowhere else.
/// Farther points, ever more sparsely, serve the plane. Rings behind one that is out of reach are not searched.
class RingSearch : public InWorkspace {
 public:
  RingSearch(const RankedScan& scan, const RankedCloud& cloud);

  /// About k points around p, which is left out, ascending by (distance, index); fewer if the scan holds no more. They
  /// get sparser with their distance. `found` is overwritten and keeps its memory. Safe to call from several threads.
  /// @returns the radius of the ball that was searched, of which `found` has not all points
  double nearest(int p, int k, Buffer<Neighbor>& found) const;

  std::size_t bytes() const;

 private:
  int ringSize(int ring) const { return begin_[ring + 1] - begin_[ring]; }

  /// The place `steps` points further around the ring, cyclically; -1 if that is the same point.
  int stepped(int place, int steps) const;
  double squaredDistance(int a, int b) const { return (points_.row(a) - points_.row(b)).squaredNorm(); }
  double distanceTo(int a, int b) const;
  /// The foot of `self` on a ring: a point nearer to it than those beside, searched from the azimuth of `from`; -1
  /// without such a ring.
  int footOn(int ring, int self, int from) const;
  /// Adds points of a ring on both sides of `foot` that lie in the ball around `self`.
  void addRing(int self, int foot, double radius, Buffer<Neighbor>& found) const;

  Buffer<int> place_;       ///< by rank, the position of the point in the order of (ring, azimuth); -1: none
  Buffer<int> rank_;        ///< by place, the rank
  Buffer<int> ring_;        ///< by place
  Buffer<double> azimuth_;  ///< by place
  Buffer<int> begin_;       ///< first place of each ring; number of places at the end
  PointBuffer points_;      ///< by place
};

}  // namespace tufted
