#pragma once

#include <Eigen/Core>
#include <optional>

namespace tufted {

/// The camera of a picture or a page, in perspective: the height of a picture covers an angle of 0.62 radians. What is
/// not given is chosen: flat scenes are seen from above at an angle, or from the front if they stand upright, all
/// others from their broad side; the distance is such that the scene fits, ignoring the few points far from all others.
struct Camera {
  /// Direction from the scene to the eye, of any length; 0: chosen.
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  /// Direction that is up in the picture, of any length; 0: chosen.
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  /// Angle of the eye around `up` in degrees, instead of `eye`; 0 is the axis that follows up: x if z is up, z if y is
  /// up.
  std::optional<double> azimuth = {};
  /// Angle of the eye above the plane perpendicular to `up` in degrees, from -90 to 90, instead of `eye`.
  std::optional<double> elevation = {};
  double zoom = 1;  ///< positive factor; 2: the eye is at half the distance
  /// Position of the eye, instead of `eye` and `zoom`.
  std::optional<Eigen::Vector3d> viewpoint = {};
  /// Position in the middle of the picture; empty: the middle of the scene.
  std::optional<Eigen::Vector3d> look_at = {};
};

}  // namespace tufted
