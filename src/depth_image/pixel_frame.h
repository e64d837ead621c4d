#pragma once

#include <Eigen/Core>
#include <optional>

#include "depth_image/pixel_window.h"

namespace tufted {

/// The tangent plane of a point, from how positions change from pixel to pixel.
struct PixelFrame {
  Eigen::Vector3d normal;  ///< unit length, from the surface to the sensor
  double radius = 0;       ///< that of a disk with the mean squared distance of the points used
};

/// The plane along which positions change with rows and columns, by least squares over the points of the window. Noise
/// along the line of sight, however large, does not turn it by its mean, as it turns principal axes.
/// @returns nothing where the pixels are on one line
std::optional<PixelFrame> fitFrame(const DepthImage& image, const PixelWindow& window, int p);

/// The frame that a given normal makes, with the size of the window.
PixelFrame frameOf(const Eigen::Vector3d& normal, const PixelWindow& window);

}  // namespace tufted
