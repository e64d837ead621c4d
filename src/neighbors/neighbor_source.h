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

/// Where the neighbours and normals of each point come from, by rank.
struct NeighborSource {
  int k = 0;                               ///< neighbours per point, at most n - 1
  std::unique_ptr<NeighborSearch> search;  ///< null when the caller's lists or the structure of a scan are used
  std::unique_ptr<RingSearch> rings;       ///< null without the rings of a scanner
  Buffer<std::size_t> list_offset;         ///< n + 1, into `list`
  Buffer<int> list;                        ///< the caller's lists, checked
  PointBuffer normals;                     ///< the caller's, unit length or zero where unusable; else 0 x 3

  /// Whether there are the caller's lists and no others.
  bool isFixed() const { return search == nullptr && rings == nullptr; }
  /// Whether the points found get sparser with their distance by design.
  bool isGraded() const { return rings != nullptr; }

  /// Whether a neighbourhood is the whole cloud of n points: then its shape is that of the cloud, and no sign of noise,
  /// other sheets, outliers or rims.
  bool isWholeCloud(Eigen::Index n) const { return n <= k + Eigen::Index{1}; }

  /// `count` neighbours of p, or the caller's list as it is. See NeighborSearch::nearest and RingSearch::nearest, whose
  /// neighbours ascend in any case.
  /// @returns the radius of the ball that was searched
  double nearest(const PointsView& points, int p, int count, Buffer<Neighbor>& found,
                 NeighborOrder order = NeighborOrder::ascending, SearchBefore* before = nullptr) const;

  /// The k neighbours of every point of [first, first + count), row after row, by one search for many. Only with
  /// `search`.
  void nearestOfEach(const PointsView& points, int first, int count, BatchScratch& scratch,
                     Buffer<Neighbor>& found) const {
    tufted::nearestOfEach(*search, points, first, count, k, kernels(), scratch, found);
  }

  std::size_t bytes() const;
};

/// The caller's normals by rank, of unit length, zero where unusable, which it counts; 0 x 3 for null.
PointBuffer rankedNormals(const Points* normals, const RankedCloud& cloud, Report& report);

/// What the options ask for, which is no depth image.
/// @param cloud borrowed for the life of the source
/// @throws InvalidInput for an index past the last point in the row of a usable point, or a structure of other points
NeighborSource neighborSource(const CloudOptions& options, const RankedCloud& cloud,
                              const std::vector<PointStatus>& status, const std::vector<int>& representative,
                              const Workers& workers, Report& report);

}  // namespace tufted
