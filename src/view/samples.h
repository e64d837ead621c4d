#pragma once

#include <Eigen/Geometry>
#include <bit>
#include <cstdint>
#include <vector>

#include "tufted/view/scene.h"
#include "view/projection.h"

namespace tufted::view {

/// What is seen at each sample of the screen, in one number: above the depth, below who is there. The least one is the
/// nearest, whoever drew first, so the order of drawing and the number of threads do not matter.
using Sample = std::uint64_t;
/// The greatest number: anything is nearer.
constexpr Sample nothing = ~Sample(0);

inline float depthOf(Sample sample) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(sample >> 32));
}
/// Below N: a point; N + t: triangle t.
inline std::uint32_t numberOf(Sample sample) {
  return static_cast<std::uint32_t>(sample);
}

/// A scene as the eye has it.
struct SeenScene {
  const Scene& scene;
  const NormalizedPoints& points;
  Projection projection;
  int width = 0, height = 0;             ///< in samples
  std::vector<Eigen::Vector3f> views;    ///< N, right, up and away from the eye; 0 where not finite
  std::vector<Eigen::Vector3f> normals;  ///< N of length 1 towards the eye, 0 where unknown; empty where all are
  std::vector<float> radii;              ///< N, of discs
  std::vector<float> screen_radii;       ///< N, of discs in samples
  std::vector<Sample> samples;           ///< rows from the top
};

/// Finds what is seen.
SeenScene look(const Scene& scene, const NormalizedPoints& points, const Projection& projection, int width, int height,
               int threads);

/// A triangle as the eye at 0 has it. What a ray through the screen meets is told by three volumes.
class SeenTriangle {
 public:
  SeenTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
      : across_{b.cross(c), c.cross(a), a.cross(b)}, volume_(a.dot(across_[0])) {}
  /// The shares of the corners where a ray meets the plane; they are all of one sign inside.
  Eigen::Vector3d shares(const Eigen::Vector3d& ray) const {
    return {ray.dot(across_[0]), ray.dot(across_[1]), ray.dot(across_[2])};
  }
  /// How long the ray is that meets the plane there.
  double lengthTo(const Eigen::Vector3d& shares) const { return volume_ / shares.sum(); }

 private:
  Eigen::Vector3d across_[3];
  double volume_;
};

/// The ray through the middle of a sample, 1 deep.
inline Eigen::Vector3d rayThrough(const Projection& projection, int x, int y) {
  return {(x + 0.5 - projection.center_x) / projection.focal, -(y + 0.5 - projection.center_y) / projection.focal, 1};
}

}  // namespace tufted::view
