// Algorithm 2 of the paper: flips of a whole cover until it is intrinsic Delaunay. flip_edges.h has the loop itself.
#include "cover/whole_cover.h"

namespace tufted {

FlipCounts flipToDelaunay(IntrinsicTriangulation& cover, const Workers& workers) {
  WholeCover whole(cover, workers);
  return flipEdges(whole, workers);
}

}  // namespace tufted
