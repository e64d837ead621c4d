#include "stars/star_wrapping.h"

#include <numeric>

#include "base/require.h"
#include "stars/inverted_star.h"

namespace tufted {
namespace {

#ifdef TUFTED_WITH_GPL
constexpr auto by_cgal = delaunayStarCgal;
#else
constexpr auto by_cgal = delaunayStar;  // never called: options are checked before
#endif

}  // namespace

StarWrapping::StarWrapping(Delaunay delaunay)
    : wrap_(delaunay == Delaunay::star ? delaunayStar : by_cgal), has_short_cut_(delaunay == Delaunay::star) {}

void StarWrapping::wrap(int p, const Eigen::Vector3d& normal, double unit, const Offsets& offsets,
                        std::span<const Neighbor> neighbors, StarMemory& memory) const {
  memory.planar.clear();
  StarKind kind = StarKind::unknown;
  projectParts(normal, unit, offsets, neighbors, [&](const PlanarOffsets& planar, std::span<const Neighbor> part) {
    if (planar.count == offsets.count && has_short_cut_)
      kind = wrapInverted(kernels_, planar, part, memory.star, memory.planar);
    if (kind == StarKind::closed || kind == StarKind::tied) return false;
    append(planar, part, memory.planar);
    return true;
  });
  if (kind == StarKind::unknown) {
    wrap_(memory.planar, p, memory.scratch, memory.star);
  } else if (kind != StarKind::closed) {  // tied or open: all of these candidates are needed, and none lies on p
    memory.scratch.chosen.swap(memory.planar);
    wrapChosen(p, memory.scratch, memory.star);
  }
}

void makeRoom(int n, BuiltStars& built) {
  built.stars.offset.assign(static_cast<std::size_t>(n) + 1, 0);
  built.stars.ends.resize(n);
  built.support.fit_radius.resize(n);
  built.support.reach.resize(n);
  built.support.isolated.resize(n);
  built.support.normals.resize(n);
}

void finishOffsets(Stars& stars) {
  requireAtMost(INT32_MAX, std::ssize(stars.link), "pointCloudLaplacian", "neighbours in the stars of all points");
  std::partial_sum(stars.offset.begin(), stars.offset.end(), stars.offset.begin());
}

}  // namespace tufted
