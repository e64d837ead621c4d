#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/real_shapes.h"
#include "tufted/types.h"

// Real scans, of which nobody knows where the surface lies: points that a method has not seen are predicted.

namespace tufted::bench {

/// Root of the mean squared heights of raw points over surfaces through others, in spacings of these. Noise that
/// neighbouring points share looks like shape to it: it compares methods and is no truth.
struct Prediction {
  double as_measured = 0;  ///< planes and quadratics through raw points, of all numbers of neighbours the best
  double denoised = 0;     ///< the same through the points that denoise() has moved
  double moved = 0;        ///< the share of points that were moved
};

/// Half of the points are hidden and predicted from the other half.
Prediction predictHidden(const Points& scan);

/// One scan is predicted from another of the same thing.
/// @param other brought near `scan`, and fitted to it here (Besl and McKay 1992, with planes for points)
Prediction predictSecond(const Points& scan, Points other);

/// The scans of the folder `scans` and of the project's real data, each in one half by its scene.
/// @returns those that exist
std::vector<ShapeFile> scanFiles(const std::filesystem::path& scans);

/// The finite points of a file.
/// @throws IoError
Points finitePoints(const std::filesystem::path& path);

}  // namespace tufted::bench
