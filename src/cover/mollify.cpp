// Intrinsic mollification, which Section 4.5 of the paper does with one length for all edges. One length that a single
// flat triangle needs ruins a thin mesh: of slack e it makes a height of about sqrt(e l). So only edges and vertices
// whose faces need it are lengthened here, and only by what they need.
#include <algorithm>

#include "base/buffer.h"
#include "cover/cover.h"
#include "cover/geometry.h"

namespace tufted {
namespace {

/// A flat face gets this slack, in its longest side: twice that of a flat one, so that rounding cannot make it flat
/// again.
constexpr double enough_slack = 2 * flat_slack;

}  // namespace

std::int64_t lengthenAtFlatFaces(IntrinsicTriangulation& cover, const Workers& workers) {
  const auto missingAt = [&cover](int side) {  // slack at the corner opposite `side`
    const double across = cover.length[side], a = cover.length[nextSide(side)], b = cover.length[previousSide(side)];
    const double longer = std::max(a, b), longest = std::max(across, longer);
    const double slack = std::min(a, b) - (across - longer);
    return slack < flat_slack * longest ? enough_slack * longest - slack : 0;
  };
  const Buffer<int> sides = numbersWhere("mollify", static_cast<int>(cover.glue.size()), workers,
                                         [&](int side) { return missingAt(side) > 0; });
  if (sides.empty()) return 0;
  Buffer<double> radius(static_cast<std::size_t>(cover.vertices), 0.0);
  for (const int side : sides) {
    double& at_corner = radius[head(cover, nextSide(side))];
    at_corner = std::max(at_corner, missingAt(side) / 2);
  }
  std::int64_t lengthened = 0;
  for (int side = 0; side < static_cast<int>(cover.glue.size()); ++side) {
    const double added = radius[tail(cover, side)] + radius[head(cover, side)];
    cover.length[side] += added;
    lengthened += added > 0 ? 1 : 0;
  }
  return lengthened / 2;
}

}  // namespace tufted
