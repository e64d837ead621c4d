#include "operators/star_mass.h"

#include "base/point_buffer.h"
#include "intrinsic/geometry.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 8192;
constexpr double least_share = 0.1;  // of the mixed area, which a sound Voronoi area exceeds by far

/// The two areas of p in one triangle (p, a, b), from its sides.
struct CornerAreas {
  double voronoi = 0;
  double mixed = 0;
};

CornerAreas cornerAreas(double pa, double pb, double ab) {
  const double area = triangleArea(pa, pb, ab);
  if (!(area > 0)) return {};
  // Four times the area times the cotangent, of the angles at p, a, b.
  const double at_p = cotanNumerator(ab, pa, pb), at_a = cotanNumerator(pb, pa, ab), at_b = cotanNumerator(pa, pb, ab);
  const double voronoi = (pa * pa * at_b + pb * pb * at_a) / (32 * area);
  if (at_p < 0) return {voronoi, area / 2};
  if (at_a < 0 || at_b < 0) return {voronoi, area / 4};
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

Buffer<double> starAreas(const Stars& stars, const PointsView& points, const Workers& workers) {
  const auto distance = [&](int a, int b) {
    Eigen::RowVector3d edge = points.row(a) - points.row(b);
    if (stars.move.rows() > 0) edge += stars.move.row(a) - stars.move.row(b);
    return edge.norm();
  };
  Buffer<double> areas(stars.size());
  workers.forBlocks("mass", stars.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (int p = static_cast<int>(begin); p < end; ++p) {
      CornerAreas sum;
      for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
        if (!stars.hasTriangle(i)) continue;
        const int a = stars.link[i], b = stars.link[stars.after(p, i)];
        const CornerAreas corner = cornerAreas(distance(p, a), distance(p, b), distance(a, b));
        sum.voronoi += corner.voronoi;
        sum.mixed += corner.mixed;
      }
      const bool fits = stars.flat[p] != 0 && sum.voronoi > least_share * sum.mixed && isInside(stars, p);
      areas[p] = fits ? sum.voronoi : sum.mixed;
    }
  });
  return areas;
}

}  // namespace tufted
