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
  /// Not null: the pixels of a depth image, see imageStructure(). Its points move along their rays. Borrowed.
  const ScanStructure* structure = nullptr;
  int threads = 0;         ///< at most this many; 0: one per processor
  Progress progress = {};  ///< called while it searches, fits and moves
};

/// What denoise() did.
struct DenoiseReport {
  std::int64_t points = 0;      ///< rows of the caller's array
  std::int64_t not_finite = 0;  ///< NaN, infinite, or beyond 1e70 median spreads or 1e152; they stay
  std::int64_t coincident = 0;  ///< equal to an earlier point; they move with it
  std::int64_t moved = 0;       ///< points that moved, without coincident ones
  /// Points that stayed because those around them are a curve, or fill a volume, or are as thick as wide.
  std::int64_t no_surface = 0;
  double pixel_fill = 0;      ///< of the depth image, see pixelFill(); 0 without one
  std::int64_t unplaced = 0;  ///< usable points that have no pixel of their own in the depth image; they stay
  /// Points that stayed because they hover over the surface of their neighbours; in a depth image those that no surface
  /// joins with another point in the 7 x 7 pixels around.
  std::int64_t outliers = 0;
  double noise = 0;  ///< median over the moved points of DenoisedPoints::noise, in the caller's unit; 0 if none moved
  double mean_move = 0;      ///< mean way of the points that moved, in the caller's unit
  double farthest_move = 0;  ///< the longest way of a point, in the caller's unit
  double seconds = 0;        ///< wall-clock
};

/// What a user must know, as warnings() of a Report.
std::vector<std::string> warnings(const DenoiseReport& report);

/// Points on the surface that noisy ones lie around.
struct DenoisedPoints {
  Points positions;  ///< N x 3, in the caller's unit; those of points that stay are the caller's bit for bit
  /// N; the standard deviation of the noise around a point that moved, along the normal (of a depth image along the
  /// ray), in the caller's unit; 0 at points that stay.
  VectorXd noise;
  DenoiseReport report;  ///< what happened
};

/// Moves the points of a noisy scan onto the surface, without a radius to choose.
///
/// Quadratics are fitted to the heights of 16, 32, 64, 128 and 256 neighbours around every third point. Where small
/// ones predict points equally well whatever their size, there is noise, which is independent from point to point;
/// where wider ones do worse, there is detail, and points stay. Of the sizes that with the least expected error counts,
/// noise that is left and bias that shows, and points move onto the weighted mean of the surfaces around. Next to
/// creases those count whose points lie on one face. Neighbours of other surfaces that pass by are left out.
///
/// Noise of a depth image lies along the line of sight, however strong it is, and pixels that are noise lie beside
/// those of the same surface. So with `structure` ranges are smoothed over pixels, as in a build:
/// the result is Laplacian::positions of pointCloudLaplacian() bit for bit.
///
/// Points of exact data, outliers, points on curves and in volumes, and whatever cannot be told from the shape of the
/// surface stay exactly where they are. Decisions look at neighbourhoods only: points of a crop, away from where it was
/// cut, move as those of the whole. A permuted cloud (with its structure) gives the permuted result; moved or turned
/// clouds that moved or turned, up to rounding (to floats, of the move); any number of threads the same bits.
/// @param points N x 3; NaN and infinite rows stay as they are
/// @throws InvalidInput for a negative number of threads, more than 2^31 points, and a structure that has rings,
/// another size than the points, no finite origin, columns that are not whole, or more pixels than ScanStructure says
/// @throws Cancelled when `options.progress` returns false
DenoisedPoints denoise(const PointsRef& points, const DenoiseOptions& options = {});

}  // namespace tufted
