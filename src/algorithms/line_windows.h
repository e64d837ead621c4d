#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "algorithms/apex.h"
#include "base/cross.h"
#include "cover/geometry.h"
#include "tufted/intrinsic_triangulation.h"

// Straight lines from the origin that are followed through faces, unfolded into one plane, in windows (Chen and Han
// 1990): ranges of directions that leave a face through one side.

namespace tufted {

/// A face beyond a side, in the plane of the lines.
struct Door {
  int side;  ///< from `left` to `right`, in the face
  Eigen::Vector2d left, right;
};

/// The third corner of the face. @param unit of the plane, in that of the surface
inline Eigen::Vector2d apexOf(const IntrinsicTriangulation& surface, double unit, const Door& door) {
  const double across = surface.length[door.side] / unit, to_right = surface.length[nextSide(door.side)] / unit,
               to_left = surface.length[previousSide(door.side)] / unit;
  return apexLeftOf(door.left, door.right, to_left, to_right, 2 * triangleArea(across, to_right, to_left));
}

/// The part of a door between two directions.
struct DoorPart {
  Eigen::Vector2d low, high;  ///< its ends
  double distance;            ///< of its nearest place from the origin
};

/// @param low, high the rightmost and the leftmost direction
inline DoorPart partBetween(const Door& door, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  const auto endOf = [&door](const Eigen::Vector2d& direction) -> Eigen::Vector2d {
    const double to_right = std::abs(cross(direction, door.right)), to_left = std::abs(cross(direction, door.left));
    if (!(to_right + to_left > 0)) return door.right;
    return (to_left * door.right + to_right * door.left) / (to_right + to_left);
  };
  const Eigen::Vector2d low_end = endOf(low), high_end = endOf(high), along = high_end - low_end;
  const double square = along.squaredNorm();
  const double share = square > 0 ? std::clamp(-low_end.dot(along) / square, 0.0, 1.0) : 0.0;
  return {low_end, high_end, (low_end + share * along).norm()};
}

/// How the directions between two pass a point.
struct Passing {
  double from_low, from_high;         ///< cross products of both directions with the point: above 0 where it lies left
  Eigen::Vector2d right_of, left_of;  ///< the leftmost direction to the right of the point, the rightmost to its left
};

inline Passing passingOf(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Eigen::Vector2d& point) {
  const Eigen::Vector2d direction = point.normalized();
  const double from_low = cross(low, point), from_high = cross(high, point);
  return {from_low, from_high,
          from_low <= 0   ? low
          : from_high < 0 ? direction
                          : high,
          from_high >= 0 ? high
          : from_low > 0 ? direction
                         : low};
}

}  // namespace tufted
