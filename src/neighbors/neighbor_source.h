#pragma once

#include <memory>
#include <vector>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "neighbors/batched_search.h"
#include "neighbors/morton.h"
#include "neighbors/neighbors.h"
#include "neighbors/scan/ring_search.h"
#include "tufted/options.h"
#include "tufted/report.h"

namespace tufted {

/// The neighbours and the caller's normals of each point, by rank (section 2 of docs/algorithm.md).
struct NeighborSource {
  int k = 0;                               ///< neighbours per point, at most n - 1
  std::unique_ptr<NeighborSearch> search;  ///< null when the caller's lists or the structure of a scan are used
  std::unique_ptr<RingSearch> rings;       ///< null without the rings of a scanner
  Buffer<std::size_t> list_offset;         ///< n + 1, start of each point's list in `list`
  Buffer<int> list;                        ///< neighbours from the caller's lists, as ranks
  PointBuffer normals;  ///< n x 3, the caller's normals, of unit length, 0 if unusable; 0 x 3 without any

  /// Whether neighbours come from the caller's lists, so that there cannot be more of them.
  bool isFixed() const { return search == nullptr && rings == nullptr; }
  /// Whether neighbours get sparser with their distance by design, as on rings.
  bool isGraded() const { return rings != nullptr; }

  /// Whether a neighbourhood is the whole cloud of n points: its shape is then that of the cloud, and tells nothing
  /// about noise, other sheets, outliers or rims.
  bool isWholeCloud(Eigen::Index n) const { return n <= k + Eigen::Index{1}; }

  /// Finds `count` neighbours of p, or returns the caller's whole list. See NeighborSearch::nearest and
  /// RingSearch::nearest; neighbours from lists and rings are always in ascending order.
  /// @returns the radius of the ball that was searched; in lists the distance to the farthest neighbour
  double nearest(const PointsView& points, int p, int count, Buffer<Neighbor>& found,
                 NeighborOrder order = NeighborOrder::ascending, SearchBefore* before = nullptr) const;

  /// The k neighbours of every point of [first, first + count), row after row, see tufted::nearestOfEach(). Requires
  /// `search`.
  void nearestOfEach(const PointsView& points, int first, int count, BatchScratch& scratch,
                     Buffer<Neighbor>& found) const {
    tufted::nearestOfEach(*search, points, first, count, k, kernels(), scratch, found);
  }

  std::size_t bytes() const;
};

/// The caller's normals by rank, n x 3, of unit length; 0 if unusable, which the report counts. 0 x 3 for null.
PointBuffer rankedNormals(const Points* normals, const RankedCloud& cloud, Report& report);

/// The source of neighbours that the options ask for, which must not name a depth image.
/// @param cloud borrowed for the life of the source
/// @throws InvalidInput if a usable point's row of CloudOptions::neighborhoods has an index beyond the last point, or
/// if the structure does not fit the points
NeighborSource neighborSource(const CloudOptions& options, const RankedCloud& cloud,
                              const std::vector<PointStatus>& status, const std::vector<int>& representative,
                              const Workers& workers, Report& report);

}  // namespace tufted
