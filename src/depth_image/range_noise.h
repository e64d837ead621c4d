#pragma once

namespace tufted {

/// The standard deviation of the noise of a depth image along its rays. Cameras that measure disparities have the same
/// everywhere in inverse depths, sensors that time light the same in ranges; what lies between is a sum of both.
struct RangeNoise {
  double of_inverse = 0;  ///< in the inverse unit of the cloud
  double of_range = 0;    ///< in the unit of the cloud

  /// Of an inverse depth, see PixelGrid::depthOf().
  double atInverse(double inverse_depth) const { return of_inverse + of_range * inverse_depth * inverse_depth; }
  /// Of a range.
  double atRange(double range, double depth) const { return of_inverse * range * depth + of_range; }
};

inline RangeNoise operator*(double factor, const RangeNoise& noise) {
  return {factor * noise.of_inverse, factor * noise.of_range};
}

}  // namespace tufted
