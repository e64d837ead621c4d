#pragma once

#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "tufted/view/scene.h"
#include "view/projection.h"

namespace tufted::view {

/// What is seen at a sample of the screen: the depth in the upper 32 bits and the number of the point or triangle in
/// the lower. The smallest one is kept, so the order of drawing and the number of threads do not matter. The sign of
/// the depth is set on the rims of wide discs, which thus hide nothing but other rims.
using Sample = std::uint64_t;
constexpr Sample rim_bit = Sample(1) << 63;
/// A sample at which nothing is seen; all others are smaller.
constexpr Sample nothing = ~Sample(0);

inline float depthOf(Sample sample) {
  return std::bit_cast<float>(static_cast<std::uint32_t>((sample & ~rim_bit) >> 32));
}
/// The index of a point, or N + t for triangle t.
inline std::uint32_t numberOf(Sample sample) {
  return static_cast<std::uint32_t>(sample);
}

/// A scene as seen from the eye.
struct SeenScene {
  const Scene& scene;
  const NormalizedPoints& points;
  Projection projection;
  int width = 0, height = 0;             ///< in samples
  std::vector<Eigen::Vector3f> views;    ///< N, by Projection::toView(); 0 if not finite
  std::vector<Eigen::Vector3f> normals;  ///< N of length 1 towards the eye, 0 if unknown; empty if all are unknown
  std::vector<float> radii;              ///< N radii of discs, normalised
  float core = 0;                        ///< radius within which discs hide what is behind them, normalised
  std::vector<float> screen_radii;       ///< N radii of discs, in samples
  std::vector<Sample> samples;           ///< rows from the top
};

/// Draws discs and triangles into samples.
SeenScene look(const Scene& scene, const NormalizedPoints& points, const Projection& projection, int width, int height,
               int threads);

/// A triangle seen from the eye at 0, for intersection with rays from it by three signed volumes. Parallel rays of
/// sight meet the triangle where rays from the eye meet its projection onto depth 1.
class SeenTriangle {
 public:
  SeenTriangle(const Projection& projection, Eigen::Vector3d a, Eigen::Vector3d b, Eigen::Vector3d c)
      : depths_(a.z(), b.z(), c.z()) {
    if (projection.is_parallel) a.z() = b.z() = c.z() = 1;
    across_ = {b.cross(c), c.cross(a), a.cross(b)};
  }
  /// Unscaled barycentric coordinates of the place where a ray meets the plane; inside all have one sign.
  Eigen::Vector3d shares(const Eigen::Vector3d& ray) const {
    return {ray.dot(across_[0]), ray.dot(across_[1]), ray.dot(across_[2])};
  }
  /// The depth of this place.
  double depthAt(const Eigen::Vector3d& shares) const { return shares.dot(depths_) / shares.sum(); }

 private:
  Eigen::Vector3d depths_;
  std::array<Eigen::Vector3d, 3> across_;
};

/// The ray through the middle of a sample, with depth 1.
inline Eigen::Vector3d rayThrough(const Projection& projection, int x, int y) {
  return {(x + 0.5 - projection.center_x) / projection.focal, -(y + 0.5 - projection.center_y) / projection.focal, 1};
}

}  // namespace tufted::view
