#pragma once

#include <limits>
#include <span>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "neighbors/neighbors.h"
#include "simd/kernels.h"
#include "tufted/types.h"

namespace tufted {

/// Points whose neighbours were found together.
struct SearchedBatch {
  int first, count;
  SearchedBall ball;
  std::size_t begin, end;  ///< of its candidates in BatchScratch::known
};

/// Memory that one worker reuses from batch to batch, and the batches of its last call of nearestOfEach().
struct BatchScratch {
  Buffer<SearchedBatch> batches;  ///< in the order of their points
  Buffer<int> known;              ///< ranks of the candidates of each
  Buffer<int> searched;           ///< those of the last search, of use or not
  int gathered = -1;              ///< the first point of the batch whose candidates stand below
  Buffer<int> candidate;          ///< ranks of those of one batch, filled up to whole packets
  Buffer<double> x, y, z;         ///< where they are
  Buffer<double> bounds;          ///< see NeighborSearch::candidates
  Buffer<double> squared;         ///< squared distances of those near one point
  Buffer<int> index;              ///< their ranks
  Buffer<float> rounded;
  Buffer<int> place, taken;
  Buffer<Neighbor> sorted;
};

/// The k nearest of every point of [first, first + count), each as NeighborSearch::nearest finds them: one search of
/// the tree for several points that lie close together, from whose candidates each point takes its own.
///
/// Neighbours along a Morton curve share nearly all of their neighbours, and walking the tree is most of the cost of a
/// search.
/// @param points what `search` was built from
/// @param found count rows of min(k, n - 1), one after the other; overwritten
/// @param radius about that of the k nearest of the first point, where it is known: the search takes less then
void nearestOfEach(const NeighborSearch& search, const PointsView& points, int first, int count, int k,
                   const Kernels& kernels, BatchScratch& scratch, Buffer<Neighbor>& found,
                   double radius = std::numeric_limits<double>::infinity());

/// The k nearest of every listed point, as by nearestOfEach(). One search serves several points that lie close together
/// and follow each other in the list.
/// @param ranks ascending
void nearestOfListed(const NeighborSearch& search, const PointsView& points, std::span<const int> ranks, int k,
                     const Kernels& kernels, BatchScratch& scratch, Buffer<Neighbor>& found,
                     double radius = std::numeric_limits<double>::infinity());

/// The k nearest of p, one of the points that nearestOfEach() was called for last, among the candidates of its batch;
/// these become more where that helps, for others of the batch as well. False, and nothing of use, where it does not.
/// @param k less than n
/// @param likely_square a squared distance that there are most often k points within, and few more
/// @param found as by NeighborSearch::nearest
bool nearestOfKnown(const NeighborSearch& search, const PointsView& points, int p, int k, double likely_square,
                    const Kernels& kernels, BatchScratch& scratch, Buffer<Neighbor>& found);

}  // namespace tufted
