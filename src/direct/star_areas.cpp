// Voronoi and mixed areas in stars (Meyer, Desbrun, Schroeder, Barr 2003, Section 3.3).
#include "direct/star_areas.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "base/point_buffer.h"
#include "cover/edge_lengths.h"
#include "cover/geometry.h"
#include "direct/triangle_fans.h"

namespace tufted {
namespace {

/// In mixed areas: what a sound Voronoi area exceeds by far, and what it keeps below by far. Ribbons gain 8 % of their
/// area with 20, 25 % with 50; 10 takes from the rims of sound surfaces.
constexpr double least_share = 0.1, most_share = 20;

/// The two areas of p in one triangle (p, a, b), or in several.
struct CornerAreas {
  double voronoi = 0;
  double mixed = 0;
};

/// @param at the triangle; its spokes are p a and p b
CornerAreas cornerAreas(const TriangleFans& fans, int at) {
  const double area = fans.area[at];
  if (!(area > 0)) return {};
  const double pa = fans.spoke[at], pb = fans.spoke[at + 1];
  const double cot_a = fans.cotan_at_own[at], cot_b = fans.cotan_at_next[at];
  const double voronoi = (pa * pa * cot_b + pb * pb * cot_a) / 8;
  if (cotanNumerator(fans.rim[at], pa, pb) < 0) return {voronoi, area / 2};
  if (cot_a < 0 || cot_b < 0) return {voronoi, area / 4};
  return {voronoi, std::min(voronoi, area)};  // cotangents of a needle may overflow
}

/// Whether the stars of p and of all its link vertices are whole.
bool isInside(const Stars& stars, int p) {
  if (stars.ends[p] != 0) return false;
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i)
    if (stars.ends[stars.link[i]] != 0) return false;
  return true;
}

/// Whether the Voronoi areas of p and of all its link vertices are within their bounds.
bool isBound(const Stars& stars, const RawBuffer<std::uint8_t>& is_bound, int p) {
  if (is_bound[p] == 0) return false;
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i)
    if (is_bound[stars.link[i]] == 0) return false;
  return true;
}

}  // namespace

void StarAreas::resize(int count) {
  voronoi.resize(count);
  mixed.resize(count);
  is_bound.resize(count);
}

void StarAreas::measure(const Stars& stars, int p, const TriangleFans& fans, int at) {
  CornerAreas sum;
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i, ++at) {
    if (!stars.hasTriangle(i)) continue;
    const CornerAreas corner = cornerAreas(fans, at);
    sum.voronoi += corner.voronoi;
    sum.mixed += corner.mixed;
  }
  voronoi[p] = sum.voronoi;
  mixed[p] = sum.mixed;
  is_bound[p] = std::abs(sum.voronoi) <= most_share * sum.mixed ? 1 : 0;
}

OwnAreas chooseAreas(const Stars& stars, StarAreas areas, const Workers& workers) {
  std::atomic<std::int64_t> bounded{0};
  workers.forBlocks("mass", stars.size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    std::int64_t bounded_here = 0;
    for (int p = static_cast<int>(begin); p < end; ++p) {
      const bool fits = stars.flat[p] != 0 && areas.voronoi[p] > least_share * areas.mixed[p];
      if (!fits || !isInside(stars, p)) continue;
      if (isBound(stars, areas.is_bound, p))
        areas.mixed[p] = areas.voronoi[p];
      else
        ++bounded_here;
    }
    bounded.fetch_add(bounded_here, std::memory_order_relaxed);
  });
  return {std::move(areas.mixed), bounded};
}

OwnAreas ownAreas(const Stars& stars, const PointsView& points, const Workers& workers) {
  const EdgeLengths length{points};
  StarAreas areas;
  areas.resize(stars.size());
  workers.forBlocks("mass", stars.size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    TriangleFanBuffer buffer;
    forEachTriangleFan(stars, length, Numbers{begin, end}, buffer,
                       [&](int p, const TriangleFans& fans, int at) { areas.measure(stars, p, fans, at); });
  });
  return chooseAreas(stars, std::move(areas), workers);
}

}  // namespace tufted
