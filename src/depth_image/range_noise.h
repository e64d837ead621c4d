#pragma once

namespace tufted {

/// The standard deviation of the noise of a depth image, as the sum of a part that is constant in inverse depths, as
/// for cameras that measure disparities, and one that is constant in depths, as for sensors that time light.
struct RangeNoise {
  double of_inverse = 0;  ///< in the inverse unit of the cloud
  double of_depth = 0;    ///< in the unit of the cloud, see PixelGrid::depthOf()

  /// The standard deviation of an inverse depth.
  double atInverse(double inverse_depth) const { return of_inverse + of_depth * inverse_depth * inverse_depth; }
  /// The standard deviation of a range, along its ray.
  double atRange(double range, double depth) const { return (of_inverse * depth * depth + of_depth) * range / depth; }
};

inline RangeNoise operator*(double factor, const RangeNoise& noise) {
  return {factor * noise.of_inverse, factor * noise.of_depth};
}

}  // namespace tufted
