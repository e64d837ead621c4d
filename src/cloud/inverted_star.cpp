#include "cloud/inverted_star.h"

namespace tufted {

bool wrapInverted(const Kernels& kernels, const PlanarOffsets& planar, std::span<const Neighbor> neighbors,
                  DelaunayStar& star) {
  InvertedStar inverted;
  if (!kernels.wrapInverted(planar, inverted)) return false;
  star.closed = true;
  star.link.clear();
  star.radius.assign(inverted.radius, inverted.radius + inverted.size);
  for (int i = 0; i < inverted.size; ++i) {
    const int q = inverted.link[i];
    star.link.push_back({planar.u[q], planar.v[q], neighbors[q].index});
  }
  return true;
}

}  // namespace tufted
