#pragma once

#include <Eigen/Core>

#include "base/buffer.h"

namespace tufted {

/// Points in a strip |y| < half, x < depth of a plane, along the rim of a surface that lies at larger x.
struct RimStrip {
  double half = 1;   ///< half the length along the rim
  double depth = 1;  ///< how far inside the strip ends
  Buffer<Eigen::Vector2d> points;
};

/// The curve x = edge + tilt (y / half) + bend ((y / half)^2 - 1/3) across a strip.
struct RimCurve {
  double edge = 0, tilt = 0, bend = 0;

  /// How far inside of the curve a place lies, along x.
  double insideOf(double half, const Eigen::Vector2d& at) const {
    const double y = at.y() / half;
    return at.x() - edge - tilt * y - bend * (y * y - 1. / 3);
  }
  /// dx / dy.
  double slopeAt(double half, double y) const { return (tilt + 2 * bend * y / half) / half; }
};

/// How the points of a strip are spread: evenly up to a curve, perhaps with more of them on it, and all moved from
/// there by normal noise along the surface.
struct RimProfile {
  RimCurve curve;
  double density = 0;     ///< points per area inside
  double line = 0;        ///< points per length on the curve
  double likelihood = 0;  ///< its logarithm
};

/// Whether there may be points on the curve itself.
enum class RimLine { none, some };

/// The most likely profile.
/// @param blur standard deviation of the noise along the surface
/// @param start where to look from: its curve, density and line, both more than 0
RimProfile fitRimProfile(const RimStrip& strip, double blur, RimLine line, const RimProfile& start);

}  // namespace tufted
