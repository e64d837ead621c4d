#pragma once

#include <limits>
#include <span>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "neighbors/neighbors.h"
#include "simd/kernels.h"
#include "tufted/types.h"

namespace tufted {

/// The points [first, first + count), served by one search.
struct SearchedBatch {
  int first, count;
  SearchedBall ball;
  std::size_t begin, end;  ///< range of its candidates in BatchScratch::known
};

/// Memory that one worker reuses for each batch, and the batches of its last call of nearestOfEach().
struct BatchScratch {
  Buffer<SearchedBatch> batches;  ///< by ascending rank
  Buffer<int> known;              ///< ranks of the candidates, batch by batch
  Buffer<int> searched;           ///< ranks that the last search found
  int gathered = -1;              ///< first point of the batch that `candidate`, `x`, `y` and `z` belong to
  Buffer<int> candidate;          ///< ranks of the candidates of one batch, padded to whole packets
  Buffer<double> x, y, z;         ///< coordinates of `candidate`
  Buffer<double> bounds;          ///< see NeighborSearch::candidates
  Buffer<double> squared;         ///< squared distances of the candidates near one point
  Buffer<int> index;              ///< their ranks
  Buffer<float> rounded;
  Buffer<int> place, taken;
  Buffer<Neighbor> sorted;
};

/// The k nearest neighbours of every point of [first, first + count), as by NeighborSearch::nearest: one search of the
/// tree serves several points that lie close together (*Batches* in section 2 of docs/algorithm.md).
///
/// Consecutive points of a Morton curve share nearly all of their neighbours, and walking the tree is most of the cost
/// of a search.
/// @param points n x 3, the points that `search` was built from
/// @param found count rows of min(k, n - 1), one after the other; overwritten
/// @param radius estimate of the distance from the first point to its k-th neighbour, for speed
void nearestOfEach(const NeighborSearch& search, const PointsView& points, int first, int count, int k,
                   const Kernels& kernels, BatchScratch& scratch, Buffer<Neighbor>& found,
                   double radius = std::numeric_limits<double>::infinity());

/// nearestOfEach() for listed points. One search serves several points that lie close together and follow each other in
/// the list.
/// @param ranks the points, ascending
void nearestOfListed(const NeighborSearch& search, const PointsView& points, std::span<const int> ranks, int k,
                     const Kernels& kernels, BatchScratch& scratch, Buffer<Neighbor>& found,
                     double radius = std::numeric_limits<double>::infinity());

/// The k nearest of p, a point of the last call of nearestOfEach(), from the candidates of its batch, or from a larger
/// ball, which is kept for later calls.
/// @returns false if the k nearest are not certain; `found` is then meaningless
/// @param k less than n
/// @param likely_square a squared distance that most likely holds k points and few more
/// @param[out] found as by NeighborSearch::nearest
bool nearestOfKnown(const NeighborSearch& search, const PointsView& points, int p, int k, double likely_square,
                    const Kernels& kernels, BatchScratch& scratch, Buffer<Neighbor>& found);

}  // namespace tufted
