#pragma once

#include <limits>

#include "cloud/delaunay_star.h"
#include "cloud/kernels.h"

namespace tufted {

/// The gap of an open star, which more points may narrow. Tells without building the star whether it stays open.
class StarGap {
 public:
  /// @param star open
  explicit StarGap(const DelaunayStar& star);

  /// Takes points in the plane of the star into account, whether they are in its link or not.
  void narrow(const PlanarOffsets& points);

  /// Whether no point lies within an angle of more than pi, beyond rounding, so that the star of the points is open.
  bool isOpen() const;

 private:
  /// The point next to the middle of the gap on one side of it.
  struct Side {
    double key = std::numeric_limits<double>::infinity();  ///< grows with the angle from the middle, 0 to 2
    double along = 0, across = 0;                          ///< in the direction of the middle and to the left of it
  };

  double x_ = 0, y_ = 0;  ///< direction of the middle
  Side left_, right_;
};

}  // namespace tufted
