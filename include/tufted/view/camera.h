#pragma once

#include <Eigen/Core>
#include <optional>

namespace tufted {

/// From where a picture or a page is seen, in perspective: a picture's height is seen under 0.62 radians. What is left
/// out is chosen: flat scenes are seen from above at an angle, or in front where they stand upright, all others at
/// their broad side; the distance is such that the scene fits, without the few points far from all others.
struct Camera {
  /// The direction in which the eye lies, of any length; 0: chosen.
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  /// The direction that is up in the picture, of any length; 0: chosen.
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  /// In degrees around `up`, in place of `eye`; 0 is the axis that follows up: x where z is up, z where y is up.
  std::optional<double> azimuth = {};
  /// In degrees above the plane to which `up` is normal, from -90 to 90, in place of `eye`.
  std::optional<double> elevation = {};
  double zoom = 1;  ///< 2: twice as near, positive
  /// The position of the eye, in place of `eye` and `zoom`.
  std::optional<Eigen::Vector3d> viewpoint = {};
  /// The position in the middle of the picture.
  std::optional<Eigen::Vector3d> look_at = {};
};

}  // namespace tufted
