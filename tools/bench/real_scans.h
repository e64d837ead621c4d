#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/real_shapes.h"
#include "tufted/types.h"

// Real scans, whose surface is unknown: methods are judged by how well they predict points that they have not seen.

namespace tufted::bench {

/// Root mean squared heights of raw points over surfaces fitted to other points, in spacings of these. Noise that
/// neighbouring points share counts as shape, so figures compare methods but are no true errors.
struct Prediction {
  double as_measured = 0;  ///< surfaces through raw points: the best of planes and quadratics over all window sizes
  double denoised = 0;     ///< the same through points moved by denoise()
  double moved = 0;        ///< share of points that were moved
};

/// Predicts half of the points from the other half.
Prediction predictHidden(const Points& scan);

/// Predicts a scan from another one of the same object.
/// @param other roughly aligned with `scan`; registered to it here (ICP, Besl and McKay 1992, with planes for points)
Prediction predictSecond(const Points& scan, Points other);

/// The scans of the folder `scans` and of the project's real data that exist, each in one half by its scene.
std::vector<ShapeFile> scanFiles(const std::filesystem::path& scans);

/// The finite points of a file.
/// @throws IoError
Points finitePoints(const std::filesystem::path& path);

}  // namespace tufted::bench
