#pragma once

#include <filesystem>

#include "tufted/types.h"

// Real depth images, whose surface is unknown: methods are judged by how well they predict inverse depths that they
// have not seen.

namespace tufted::bench {

/// An image of a pinhole camera that looks along z.
struct RealImage {
  Points points;  ///< row by row; missing pixels are not finite
  int width = 0, height = 0;

  bool isOne() const { return width == 640 && height == 480; }
};

/// Root mean squared errors of predicted inverse depths, in 1e-3 / m, of the best of planes and quadratics over windows
/// of 3 to 25 pixels. Only pixels at least 5 pixels from jumps and missing pixels count.
struct ImagePrediction {
  double as_measured = 0, by_tree = 0, by_pixels = 0;
};

/// Predicts every second row from the others. Noise that neighbouring rows share counts as shape.
ImagePrediction predictHiddenRows(const RealImage& image);

/// Predicts a view of the same scene from nearby, which has independent noise. It is registered to the first one by
/// PlaneSteps, pixel by pixel. The mean error of each block of 24 x 24 pixels, due to calibration, is subtracted.
ImagePrediction predictSecondView(const RealImage& image, const RealImage& other);

/// Reads an image. @throws IoError
RealImage realImage(const std::filesystem::path& path);

}  // namespace tufted::bench
