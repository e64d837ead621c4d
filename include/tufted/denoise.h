#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tufted/options.h"
#include "tufted/scan_structure.h"
#include "tufted/types.h"

namespace tufted {

/// Options of denoise().
struct DenoiseOptions {
  /// The pixels of a depth image, see imageStructure(), whose points then move along their rays; null: none. Borrowed.
  const ScanStructure* structure = nullptr;
  int threads = 0;         ///< at most this many threads; 0: one per processor
  Progress progress = {};  ///< called while it searches, fits and moves
};

/// Counts and distances of a call of denoise().
struct DenoiseReport {
  std::int64_t points = 0;      ///< rows of the caller's array
  std::int64_t not_finite = 0;  ///< points of PointStatus::not_finite; they stay in place
  std::int64_t coincident = 0;  ///< points equal to an earlier one; they move with it
  std::int64_t moved = 0;       ///< points that moved, coincident ones not counted
  /// Points that stayed because their neighbourhood is a curve, a volume, or as thick as wide.
  std::int64_t no_surface = 0;
  double sparse_share = 0;    ///< sparseShare() of the depth image; 0 without one
  std::int64_t unplaced = 0;  ///< usable points without a pixel of their own in the depth image; they stay in place
  /// Points that stayed because they hover over the surface of their neighbours; in a depth image points that no
  /// surface joins to another point in the 7 x 7 pixels around.
  std::int64_t outliers = 0;
  double noise = 0;  ///< median over the moved points of DenoisedPoints::noise, in the caller's unit; 0 if none moved
  double mean_move = 0;      ///< mean distance that the moved points moved, in the caller's unit
  double farthest_move = 0;  ///< greatest distance that a point moved, in the caller's unit
  double seconds = 0;        ///< wall-clock
};

/// Warnings that a user should see after denoise(), one sentence each; empty if all is well.
std::vector<std::string> warnings(const DenoiseReport& report);

/// Result of denoise().
struct DenoisedPoints {
  Points positions;  ///< N x 3, in the caller's unit; bit for bit the caller's points where they stay in place
  /// N; standard deviation of the noise around a point that moved, along the normal (in a depth image along the ray),
  /// in the caller's unit; 0 at points that stay.
  VectorXd noise;
  DenoiseReport report;  ///< counts and distances
};

/// Moves the points of a noisy scan onto the surface, without a radius to choose.
///
/// Quadratic heights are fitted to 16, 32, 64, 128 and 256 neighbours around every third point. Where small fits
/// predict other points equally well whatever their size, there is noise, independent from point to point; where larger
/// fits do worse, there is detail, and points stay. The size with the least expected error, from remaining noise and
/// from bias, is chosen, and points move onto the weighted mean of the surfaces around them. Beside a crease only
/// surfaces count whose points lie on one face. Neighbours on other sheets are left out.
///
/// Noise of a depth image is along the line of sight, however strong, and the neighbours of a noisy pixel are still of
/// the same surface. So with `structure` the ranges of pixels are smoothed, as in a build: the result is
/// Laplacian::positions of pointCloudLaplacian() bit for bit.
///
/// Points of exact data, outliers, points on curves and in volumes, and noise that is indistinguishable from the shape
/// of the surface stay exactly where they are. Decisions are local: away from the cut, points of a crop move as in the
/// whole cloud. A permuted cloud (with its structure) gives the permuted result; a translated or rotated one the
/// translated or rotated result, up to rounding (of a translation, to floats). The result has the same bits for any
/// number of threads.
/// @param points N x 3; points that are not finite stay as they are
/// @throws InvalidInput for a negative number of threads, 2^31 points or more, or a structure that has rings, another
/// size than the points, an origin that is not finite, columns that are not whole numbers, or more pixels than
/// ScanStructure allows
/// @throws Cancelled when `options.progress` returns false
DenoisedPoints denoise(const PointsRef& points, const DenoiseOptions& options = {});

}  // namespace tufted
