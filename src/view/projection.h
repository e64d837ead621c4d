#pragma once

#include <Eigen/Core>
#include <vector>

#include "tufted/view/picture.h"

namespace tufted::view {

/// The points of a scene in coordinates of about 1 around 0, and the numbers of those that are finite.
struct NormalizedPoints {
  Points positions;
  std::vector<int> finite;
  double unit = 1;  ///< the scene's length of 1 in `positions`
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  int exponent = 0;

  /// A position of the scene in these coordinates.
  Eigen::Vector3d at(const Eigen::Vector3d& position) const;
};

/// @param scene its finite points are moved and scaled so that most lie between -1 and 1
NormalizedPoints normalize(const Scene& scene, int threads);

/// The part of a picture that the scene is drawn into, in samples.
struct Viewport {
  int left = 0, right = 0, top = 0, bottom = 0;  ///< where the scene should fit into
};

/// Takes normalised positions to the screen.
struct Projection {
  Eigen::Vector3d target, right, up, back;  ///< `back` points to the eye
  double distance = 1;                      ///< of the eye from the target
  double focal = 1;                         ///< samples for a slope of 1
  double center_x = 0, center_y = 0;        ///< where the target is seen

  /// Right, up and away from the eye, which is at 0.
  Eigen::Vector3d toView(const Eigen::Vector3d& position) const {
    const Eigen::Vector3d from_target = position - target;
    return {from_target.dot(right), from_target.dot(up), distance - from_target.dot(back)};
  }
  /// A direction in the same axes.
  Eigen::Vector3d turn(const Eigen::Vector3d& direction) const {
    return {direction.dot(right), direction.dot(up), -direction.dot(back)};
  }
  double screenX(const Eigen::Vector3d& view) const { return center_x + focal * view.x() / view.z(); }
  double screenY(const Eigen::Vector3d& view) const { return center_y - focal * view.y() / view.z(); }
};

/// Nothing nearer to the eye than this is drawn, in normalised coordinates.
constexpr double nearest_depth = 1e-3;

/// @param function what the caller called, for the message
/// @throws InvalidInput for a camera that is not valid
void checkCamera(const Camera& camera, const char* function);

/// @param camera a valid one
Projection project(const NormalizedPoints& points, const Camera& camera, const Viewport& viewport);

}  // namespace tufted::view
