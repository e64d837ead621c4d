#pragma once

#include <filesystem>

#include "tufted/types.h"

// Real depth images, of which nobody knows where the surface lies: inverse depths that a method has not seen are
// predicted.

namespace tufted::bench {

/// An image of a pinhole camera that looks along z.
struct RealImage {
  Points points;  ///< row by row; not finite where a pixel is missing
  int width = 0, height = 0;

  bool isOne() const { return width == 640 && height == 480; }
};

/// Root of the mean squared error of predicted inverse depths, in 1e-3 / m, by planes and quadratics over windows of 3
/// to 25 pixels, of all the best. Pixels count that lie at least 5 from the next jump or missing one.
struct ImagePrediction {
  double as_measured = 0, by_tree = 0, by_pixels = 0;
};

/// Every second row is hidden and predicted from the others. What noise neighbouring rows share looks like shape.
ImagePrediction predictHiddenRows(const RealImage& image);

/// Another view of the same thing, from nearby, is predicted: the two do not share their noise. It is brought onto the
/// first by steps from points to planes (Chen and Medioni 1992), each point beside what its pixel shows; and the mean
/// error of each block of 24 x 24 pixels, by which the calibrated camera is off, does not count.
ImagePrediction predictSecondView(const RealImage& image, const RealImage& other);

/// @throws IoError
RealImage realImage(const std::filesystem::path& path);

}  // namespace tufted::bench
