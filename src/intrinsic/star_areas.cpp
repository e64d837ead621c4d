#include "intrinsic/star_areas.h"

#include "base/point_buffer.h"
#include "intrinsic/edge_lengths.h"
#include "intrinsic/fan_buffer.h"
#include "intrinsic/geometry.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 8192;
constexpr double least_share = 0.1;  // of the mixed area, which a sound Voronoi area exceeds by far

/// The two areas of p in one triangle (p, a, b), or in several.
struct CornerAreas {
  double voronoi = 0;
  double mixed = 0;
};

/// @param at the triangle; its spokes are p a and p b
CornerAreas cornerAreas(const Fans& fans, int at) {
  const double area = fans.area[at];
  if (!(area > 0)) return {};
  const double pa = fans.spoke[at], pb = fans.spoke[at + 1];
  const double cot_a = fans.cotan_at_own[at], cot_b = fans.cotan_at_next[at];
  const double voronoi = (pa * pa * cot_b + pb * pb * cot_a) / 8;
  if (cotanNumerator(fans.rim[at], pa, pb) < 0) return {voronoi, area / 2};
  if (cot_a < 0 || cot_b < 0) return {voronoi, area / 4};
  return {voronoi, voronoi};
}

/// Whether p and all its link vertices have closed stars that lost nothing.
bool isInside(const Stars& stars, int p) {
  if (stars.ends[p] != 0) return false;
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i)
    if (stars.ends[stars.link[i]] != 0) return false;
  return true;
}

}  // namespace

double starArea(const Stars& stars, int p, const Fans& fans, int at) {
  CornerAreas sum;
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i, ++at) {
    if (!stars.hasTriangle(i)) continue;
    const CornerAreas corner = cornerAreas(fans, at);
    sum.voronoi += corner.voronoi;
    sum.mixed += corner.mixed;
  }
  const bool fits = stars.flat[p] != 0 && sum.voronoi > least_share * sum.mixed && isInside(stars, p);
  return fits ? sum.voronoi : sum.mixed;
}

Buffer<double> starAreas(const Stars& stars, const PointsView& points, const Workers& workers) {
  const EdgeLengths length{points, stars.move};
  Buffer<double> areas(stars.size());
  workers.forBlocks("mass", stars.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    FanBuffer buffer;
    forEachFan(stars, length, Numbers{begin, end}, buffer,
               [&](int p, const Fans& fans, int at) { areas[p] = starArea(stars, p, fans, at); });
  });
  return areas;
}

}  // namespace tufted
