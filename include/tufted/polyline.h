#pragma once

#include "tufted/types.h"

namespace tufted {

/// A line on a surface: an isoline, or what GeodesicTracer traces.
struct Polyline {
  Points points;           ///< K x 3, in order, in the points' unit; a closed line does not repeat its first point
  bool is_closed = false;  ///< whether the last point is joined to the first
  double length = 0;       ///< in the points' unit, of a closed line with the way back to its first point
  double value = 0;        ///< of the field along an isoline, in its unit; 0 on other lines
};

}  // namespace tufted
