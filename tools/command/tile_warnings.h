#pragma once

#include <string>
#include <vector>

#include "tufted/report.h"
#include "tufted/tiles.h"

/// What must be known of a cloud that was built by tiles.
inline std::vector<std::string> tileWarnings(const tufted::TileReport& report) {
  tufted::Report counts;
  counts.points = report.points;
  counts.active = report.active;
  counts.not_finite = report.not_finite;
  counts.coincident = report.coincident;
  counts.isolated = report.isolated;
  return tufted::warnings(counts);
}
