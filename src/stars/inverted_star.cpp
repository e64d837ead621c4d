#include "stars/inverted_star.h"

namespace tufted {

StarKind wrapInverted(const Kernels& kernels, const PlanarOffsets& planar, std::span<const Neighbor> neighbors,
                      DelaunayStar& star, Buffer<PlanarPoint>& tied) {
  InvertedStar inverted;
  const StarKind kind = kernels.wrapInverted(planar, inverted);
  const auto take = [&](Buffer<PlanarPoint>& points) {
    points.clear();
    for (int i = 0; i < inverted.size; ++i) {
      const int q = inverted.link[i];
      points.push_back({planar.u[q], planar.v[q], neighbors[q].index});
    }
  };
  if (kind == StarKind::tied) take(tied);
  if (kind != StarKind::closed) return kind;
  star.closed = true;
  star.radius.assign(inverted.radius, inverted.radius + inverted.size);
  take(star.link);
  return kind;
}

}  // namespace tufted
