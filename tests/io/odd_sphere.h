#pragma once

#include <cstdint>
#include <limits>
#include <random>

#include "tufted/io/read.h"

namespace tufted {

/// 200 random points on a sphere; point 7 is a copy of point 3, point 9 is not finite.
inline Geometry oddSphere(std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  Geometry geometry;
  geometry.points.resize(200, 3);
  for (double& x : geometry.points.reshaped()) x = static_cast<double>(generator() >> 11) * 0x1p-53 - 0.5;
  geometry.points.rowwise().normalize();
  geometry.points.row(7) = geometry.points.row(3);
  geometry.points.row(9).setConstant(std::numeric_limits<double>::quiet_NaN());
  geometry.width = 200;
  return geometry;
}

}  // namespace tufted
