#pragma once

#include <Eigen/Core>
#include <optional>

#include "depth_image/pixel_window.h"

namespace tufted {

/// The tangent plane of a point (step 5 in section 28 of docs/algorithm.md).
struct PixelFrame {
  Eigen::Vector3d normal;  ///< unit length, from the surface to the sensor
  double radius = 0;       ///< radius of a disk with the same mean squared distance as the window's points
};

/// The plane spanned by the changes of positions with rows and with columns, by least squares over the window. Noise
/// along the line of sight, however strong, turns it only by its mean, unlike principal axes.
/// @returns nothing if the pixels are on one line
std::optional<PixelFrame> fitFrame(const DepthImage& image, const PixelWindow& window, int p);

/// The frame with a given normal and the radius of the window.
PixelFrame frameOf(const Eigen::Vector3d& normal, const PixelWindow& window);

}  // namespace tufted
