#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace tufted {

/// A pixel and the ray to the point that is in it.
struct Sighting {
  Eigen::Vector2d pixel;  ///< from -1 to 1 over the image
  Eigen::Vector3d ray;    ///< unit length
};

/// The axis of the pinhole camera that has these rays in these pixels, unit length, towards what it sees. Nothing where
/// there is none, as with fewer than 100 sightings, fewer than 8 rows or columns, or most of the rays two pixels off.
std::optional<Eigen::Vector3d> opticalAxis(std::span<const Sighting> sightings, int width, int height);

}  // namespace tufted
