#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <span>

#include "base/buffer.h"
#include "neighbors/neighbors.h"
#include "simd/kernels.h"
#include "stars/blocks_in_order.h"
#include "stars/delaunay_star.h"
#include "stars/stars.h"
#include "stars/tangent_frame.h"
#include "tufted/options.h"

namespace tufted {

/// Projects neighbours to the tangent plane, times `unit`, and calls visit(planar, neighbors) for as many at a time as
/// `planar` holds, until it returns false.
/// @param offsets of the neighbours
template <class Visit>
void projectParts(const Eigen::Vector3d& normal, double unit, const Offsets& offsets,
                  std::span<const Neighbor> neighbors, const Visit& visit) {
  const Kernels& kernel = kernels();
  const Eigen::Vector3d x = tangentOf(normal), y = normal.cross(x);
  PlanarOffsets planar;
  for (int first = 0; first < offsets.count; first += PlanarOffsets::most) {
    const int count = std::min(offsets.count - first, PlanarOffsets::most);
    kernel.project({count, offsets.x + first, offsets.y + first, offsets.z + first}, unit, x.data(), y.data(), planar);
    if (!visit(planar, neighbors.subspan(first, count))) break;
  }
}

inline void append(const PlanarOffsets& planar, std::span<const Neighbor> neighbors, Buffer<PlanarPoint>& points) {
  for (int i = 0; i < planar.count; ++i) points.push_back({planar.u[i], planar.v[i], neighbors[i].index});
}

/// Memory and counts of one worker, reused for each star.
struct StarMemory {
  Buffer<PlanarPoint> planar;
  StarScratch scratch;
  DelaunayStar star;
  BlockOfStars block;
  std::int64_t open_stars = 0, unusable_triangles = 0;
};

/// Finds Delaunay stars as the options say (section 6 of docs/algorithm.md).
class StarWrapping {
 public:
  explicit StarWrapping(Delaunay delaunay);

  /// Sets memory.star to the star of p among the neighbours.
  /// @param unit factor from offsets to the plane: a power of two near the inverse size of the neighbourhood
  void wrap(int p, const Eigen::Vector3d& normal, double unit, const Offsets& offsets,
            std::span<const Neighbor> neighbors, StarMemory& memory) const;

 private:
  using Wrap = void (*)(const Buffer<PlanarPoint>&, int, StarScratch&, DelaunayStar&);

  const Kernels& kernels_ = kernels();
  Wrap wrap_;
  bool has_short_cut_;
};

/// Resizes the arrays per point for n points.
void makeRoom(int n, BuiltStars& built);

/// Appends memory.star to memory.block, with radii times `unit`; sets `ends` and the size of star p.
/// @param keeps keeps(a, b): whether a triangle with link vertices a and b may stay
template <class Keeps>
void storeStar(int p, double unit, const Keeps& keeps, StarMemory& memory, Stars& stars) {
  const DelaunayStar& star = memory.star;
  memory.open_stars += star.closed ? 0 : 1;
  stars.ends[p] = star.closed ? 0 : 1;
  stars.offset[p + 1] = static_cast<int>(star.link.size());
  for (int i = 0; i < static_cast<int>(star.link.size()); ++i) {
    memory.block.link.push_back(star.link[i].index);
    const bool is_triangle = i < star.triangles();
    const bool is_usable =
        is_triangle && std::isfinite(star.radius[i]) && keeps(star.link[i].index, star.after(i).index);
    memory.block.radius.push_back(is_usable ? star.radius[i] * unit : 0);
    memory.block.triangle.push_back(is_usable ? 1 : 0);
    if (is_triangle && !is_usable) {
      ++memory.unusable_triangles;
      stars.ends[p] = 1;
    }
  }
}

/// Turns sizes, that of star p in stars.offset[p + 1], into offsets.
void finishOffsets(Stars& stars);

}  // namespace tufted
