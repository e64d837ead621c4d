// Intrinsic mollification (section 10 of docs/algorithm.md). Section 4.5 of the paper adds one length to all edges.
// What a single flat triangle needs would ruin a thin mesh: a slack of e makes a height of about sqrt(e l). So only
// edges at faces that need slack are lengthened here, and only by as much as these need.
#include <algorithm>

#include "base/buffer.h"
#include "cover/cover.h"
#include "cover/geometry.h"

namespace tufted {
namespace {

/// The slack that a flat face gets, as a share of its longest side: twice `flat_slack`, so that rounding cannot make it
/// flat again.
constexpr double enough_slack = 2 * flat_slack;

}  // namespace

std::int64_t lengthenAtFlatFaces(IntrinsicTriangulation& cover, const Workers& workers) {
  const auto missingAt = [&cover](int side) {  // slack that the face needs at the corner opposite `side`
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
