// Mixed areas in stars (Meyer, Desbrun, Schroeder, Barr 2003, Section 3.3).
#include "direct/star_areas.h"

#include <algorithm>
#include <cmath>

#include "cover/edge_lengths.h"
#include "cover/geometry.h"

namespace tufted {
namespace {

/// The part of the triangle (p, a, b) that is nearest to p, or half or a quarter of it if it is obtuse.
double mixedArea(double pa, double ab, double bp) {
  const double area = triangleArea(pa, ab, bp);
  if (!(area > 0)) return 0;
  const double at_p = cotanNumerator(ab, pa, bp), at_a = cotanNumerator(bp, ab, pa), at_b = cotanNumerator(pa, bp, ab);
  if (at_p < 0) return area / 2;
  if (at_a < 0 || at_b < 0) return area / 4;
  return std::min(area, (bp * bp * (at_a / area) + pa * pa * (at_b / area)) / 32);  // cotangents may overflow
}

}  // namespace

RawBuffer<double> ownAreas(const Stars& stars, const PointsView& points, const Workers& workers) {
  const EdgeLengths length{points};
  RawBuffer<double> areas(static_cast<std::size_t>(stars.size()));
  workers.forBlocks("mass", stars.size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (int p = static_cast<int>(begin); p < end; ++p) {
      areas[p] = 0;
      if (stars.ends[p] == 0) continue;
      for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
        if (!stars.hasTriangle(i)) continue;
        const int a = stars.link[i], b = stars.link[stars.after(p, i)];
        areas[p] += mixedArea(length(p, a), length(a, b), length(b, p));
      }
    }
  });
  return areas;
}

}  // namespace tufted
