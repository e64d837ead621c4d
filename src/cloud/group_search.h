#pragma once

#include <vector>

#include "cloud/kernels.h"
#include "cloud/neighbors.h"
#include "tufted/types.h"

namespace tufted {

/// Memory that one worker reuses from group to group.
struct GroupScratch {
  std::vector<int> candidate;   ///< ranks of those of the group, filled up to whole lanes
  std::vector<double> x, y, z;  ///< where they are
  std::vector<double> bounds;   ///< see NeighborSearch::candidates
  std::vector<double> squared;  ///< squared distances of those near one point
  std::vector<int> index;       ///< their ranks
  std::vector<float> rounded;
  std::vector<int> place;
  std::vector<Neighbor> sorted;
};

/// The k nearest of every point of [first, first + count), each as NeighborSearch::nearest finds them: one search of
/// the tree for several points that lie close together, from whose candidates each point takes its own.
///
/// Neighbours along a Morton curve share nearly all of their neighbours, and walking the tree is most of the cost of a
/// search.
/// @param points what `search` was built from
/// @param found count rows of min(k, n - 1), one after the other; overwritten
void nearestOfEach(const NeighborSearch& search, const Points& points, int first, int count, int k,
                   const Kernels& kernels, GroupScratch& scratch, std::vector<Neighbor>& found);

}  // namespace tufted
