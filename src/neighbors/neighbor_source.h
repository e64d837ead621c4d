#pragma once

#include <memory>
#include <vector>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "neighbors/batched_search.h"
#include "neighbors/morton.h"
#include "neighbors/neighbors.h"
#include "neighbors/own_side.h"
#include "neighbors/scan/ring_search.h"
#include "tufted/options.h"
#include "tufted/report.h"

namespace tufted {

/// Neighbours and normals of each point, by rank (section 2 of docs/algorithm.md).
struct NeighborSource {
  int k = 0;                               ///< number of neighbours per point, at most n - 1
  std::unique_ptr<NeighborSearch> search;  ///< null when the caller's lists or the structure of a scan are used
  std::unique_ptr<RingSearch> rings;       ///< null without the rings of a scanner
  Buffer<std::size_t> list_offset;         ///< n + 1, starts in `list`
  Buffer<int> list;                        ///< neighbours from the caller's lists, as ranks
  PointBuffer normals;  ///< n x 3, the caller's normals, of unit length, 0 if unusable; 0 x 3 without any

  /// Whether all neighbours come from the caller's lists.
  bool isFixed() const { return search == nullptr && rings == nullptr; }
  /// Whether neighbours get sparser with their distance by design, as on rings.
  bool isGraded() const { return rings != nullptr; }

  /// Whether a neighbourhood is the whole cloud of n points, and so tells nothing about noise, other sheets, outliers
  /// or rims.
  bool isWholeCloud(Eigen::Index n) const { return n <= k + Eigen::Index{1}; }

  /// `count` neighbours of p, or the caller's list; see NeighborSearch::nearest and RingSearch::nearest. Those of lists
  /// and rings always ascend.
  /// @returns the radius that was searched; of a list the distance to its last neighbour
  double nearest(const PointsView& points, int p, int count, Buffer<Neighbor>& found,
                 NeighborOrder order = NeighborOrder::ascending, SearchBefore* before = nullptr) const;

  /// Removes the neighbours on the other side of a thin part, see tufted::keepOwnSide().
  void keepOwnSide(const PointsView& points, int p, Buffer<Neighbor>& neighbors) const {
    if (!isFixed()) neighbors.resize(tufted::keepOwnSide(points, normals, p, neighbors));
  }

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

/// The source that the options ask for, without a depth image.
/// @param cloud borrowed for the life of the source
/// @throws InvalidInput for an index beyond the last point in the row of a usable point, and for a structure of other
/// points
NeighborSource neighborSource(const CloudOptions& options, const RankedCloud& cloud,
                              const std::vector<PointStatus>& status, const std::vector<int>& representative,
                              const Workers& workers, Report& report);

}  // namespace tufted
