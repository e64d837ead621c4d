#include "operators/star_mass.h"

#include "intrinsic/geometry.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 8192;
constexpr double least_share = 0.1;  // of the mixed area, which a sound Voronoi area exceeds by far

/// The two areas of p in one triangle (p, a, b).
struct CornerAreas {
  double voronoi = 0;
  double mixed = 0;
};

CornerAreas cornerAreas(const Points& x, int p, int a, int b) {
  const double pa = (x.row(p) - x.row(a)).norm(), pb = (x.row(p) - x.row(b)).norm(), ab = (x.row(a) - x.row(b)).norm();
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

VectorXd starAreas(const Stars& stars, const Points& positions, const Workers& workers) {
  VectorXd areas = VectorXd::Zero(stars.size());
  workers.forBlocks("mass", stars.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (int p = static_cast<int>(begin); p < end; ++p) {
      CornerAreas sum;
      for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
        if (!stars.hasTriangle(i)) continue;
        const CornerAreas corner = cornerAreas(positions, p, stars.link[i], stars.link[stars.after(p, i)]);
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
