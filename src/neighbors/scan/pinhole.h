#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace tufted {

/// A pixel and the direction from the sensor to its point.
struct Sighting {
  Eigen::Vector2d pixel;  ///< column and row, each from -1 to 1 over the image
  Eigen::Vector3d ray;    ///< unit length
};

/// The axis of the pinhole camera that maps these rays to these pixels, of unit length, towards the points. Empty with
/// fewer than 100 sightings, 8 rows or 8 columns, a median error above 0.5 pixels, or more than 5 % of errors above 2
/// pixels or of points behind the camera.
std::optional<Eigen::Vector3d> opticalAxis(std::span<const Sighting> sightings, int width, int height);

}  // namespace tufted
