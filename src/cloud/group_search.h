#pragma once

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "cloud/kernels.h"
#include "cloud/neighbors.h"
#include "tufted/types.h"

namespace tufted {

/// Memory that one worker reuses from group to group.
struct GroupScratch {
  Buffer<int> candidate;   ///< ranks of those of the group, filled up to whole lanes
  Buffer<double> x, y, z;  ///< where they are
  Buffer<double> bounds;   ///< see NeighborSearch::candidates
  Buffer<double> squared;  ///< squared distances of those near one point
  Buffer<int> index;       ///< their ranks
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
void nearestOfEach(const NeighborSearch& search, const PointsView& points, int first, int count, int k,
                   const Kernels& kernels, GroupScratch& scratch, Buffer<Neighbor>& found);

}  // namespace tufted
