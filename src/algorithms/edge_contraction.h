#pragma once

#include <vector>

#include "algorithms/signed_sets.h"
#include "base/parallel.h"

namespace tufted {

/// Two neighbours.
struct SignedEdge {
  int low, high;
  double alike;  ///< -1 to 1; positive if both have the same sign, larger if that is more certain
};

/// Joins all sets that edges connect, the most certain pair first. The certainty of a pair is the sum over all edges
/// between its two sets, so a few wrong edges do not matter (greedy additive edge contraction, Keuper et al. 2015).
/// @param edges each pair once, with low < high
/// @param[in,out] sets each element alone at first
void contractEdges(const std::vector<SignedEdge>& edges, SignedSets& sets, const Workers& workers);

}  // namespace tufted
