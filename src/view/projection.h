#pragma once

#include <Eigen/Core>
#include <vector>

#include "tufted/view/picture.h"

namespace tufted::view {

/// The points of a scene in normalised coordinates, most of them in [-1, 1], and the indices of the finite ones.
struct NormalizedPoints {
  Points positions;
  std::vector<int> finite;
  double unit = 1;  ///< length in `positions` of the scene's unit
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  int exponent = 0;

  /// Normalises a position of the scene.
  Eigen::Vector3d at(const Eigen::Vector3d& position) const;
};

/// Moves and scales the finite points of a scene so that most lie in [-1, 1].
NormalizedPoints normalize(const Scene& scene, int threads);

/// The part of a picture into which the scene is fitted, in samples.
struct Viewport {
  int left = 0, right = 0, top = 0, bottom = 0;  ///< first column and row, and those after the last
};

/// Maps normalised positions to the screen.
struct Projection {
  Eigen::Vector3d target, right, up, back;  ///< `back` points to the eye
  double distance = 1;                      ///< distance of the eye from the target
  double focal = 1;                         ///< samples that a slope of 1 covers; in parallel projection a length of 1
  double center_x = 0, center_y = 0;        ///< place of the target on the screen, in samples
  bool is_parallel = false;                 ///< whether rays of sight are parallel

  /// A position in the axes right, up and away from the eye, which is at 0.
  Eigen::Vector3d toView(const Eigen::Vector3d& position) const {
    const Eigen::Vector3d from_target = position - target;
    return {from_target.dot(right), from_target.dot(up), distance - from_target.dot(back)};
  }
  /// A direction in the axes of toView().
  Eigen::Vector3d turn(const Eigen::Vector3d& direction) const {
    return {direction.dot(right), direction.dot(up), -direction.dot(back)};
  }
  /// Samples that a length of 1 covers at a depth.
  double scaleAt(double depth) const { return is_parallel ? focal : focal / depth; }
  double screenX(const Eigen::Vector3d& view) const { return center_x + scaleAt(view.z()) * view.x(); }
  double screenY(const Eigen::Vector3d& view) const { return center_y - scaleAt(view.z()) * view.y(); }
  /// The direction in which the eye sees a position.
  Eigen::Vector3d sight(const Eigen::Vector3d& view) const { return is_parallel ? Eigen::Vector3d::UnitZ() : view; }
};

/// What is nearer to the eye than this, in normalised coordinates, is not drawn.
constexpr double nearest_depth = 1e-3;

/// @param function name of the public function, for the message
/// @throws InvalidInput for a camera that is not finite or out of range
void checkCamera(const Camera& camera, const char* function);

/// Places the camera, which passed checkCamera(), and chooses what it leaves open.
Projection project(const NormalizedPoints& points, const Camera& camera, const Viewport& viewport);

}  // namespace tufted::view
