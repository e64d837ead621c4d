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

/// Calls visit(planar, neighbors) for neighbours projected to the tangent plane, times `unit`, as many at a time as
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

/// Memory of one worker for the star of one point after the other.
struct StarMemory {
  Buffer<PlanarPoint> planar;
  StarScratch scratch;
  DelaunayStar star;
  BlockOfStars block;
  std::int64_t open_stars = 0, unusable_triangles = 0;
};

/// Finds Delaunay stars as the options say.
class StarWrapping {
 public:
  explicit StarWrapping(Delaunay delaunay);

  /// memory.star becomes the star of p among the neighbours.
  /// @param unit of the plane: about one over the size of the neighbourhood, a power of two
  void wrap(int p, const Eigen::Vector3d& normal, double unit, const Offsets& offsets,
            std::span<const Neighbor> neighbors, StarMemory& memory) const;

 private:
  using Wrap = void (*)(const Buffer<PlanarPoint>&, int, StarScratch&, DelaunayStar&);

  const Kernels& kernels_ = kernels();
  Wrap wrap_;
  bool has_short_cut_;
};

/// Memory for the stars of n points.
void makeRoom(int n, BuiltStars& built);

/// Puts memory.star, times `unit`, into memory.block, and whether it ends into `stars`.
/// @param keeps(a, b) whether a triangle with link vertices a and b may stay
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

/// Turns the sizes of stars, of which `stars.offset` holds those before each, into offsets.
void finishOffsets(Stars& stars);

}  // namespace tufted
