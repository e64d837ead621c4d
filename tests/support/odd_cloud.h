#pragma once

#include <cmath>

#include "shapes/shapes.h"

namespace tufted::support {

/// Two separate spheres of 1000 points each, copies of points 5 and 8, a point that is not finite and an isolated one.
inline Points oddCloud() {
  Points points(2004, 3);
  points.topRows(1000) = shapes::sphere(1000).points;
  points.middleRows(1000, 1000) = shapes::sphere(1000, shapes::Sampling::uniform, 2).points.array() + 10;
  points.row(2000) = points.row(5);
  points.row(2001) = points.row(8);
  points.row(2002).setConstant(NAN);
  points.row(2003) << 1e6, 0, 0;
  return points;
}

/// A disk of 1000 points and a separate sphere of 500, a copy of point 7, a point that is not finite and an isolated
/// one.
inline Points oddDisk() {
  Points points(1503, 3);
  points.topRows(1000) = shapes::disk(1000).points;
  points.middleRows(1000, 500) = 0.3 * shapes::sphere(500).points;
  points.middleRows(1000, 500).col(0).array() += 5;
  points.row(1500) = points.row(7);
  points.row(1501).setConstant(NAN);
  points.row(1502) << 1e6, 0, 0;
  return points;
}

}  // namespace tufted::support
