#pragma once

#include <string>

#include "tufted/io/read.h"
#include "tufted/scan_structure.h"

namespace tufted {

/// The rings of a spinning scanner's file: by its field `ring`, or else by the elevations seen from its viewpoint,
/// which must show rings; and by its field `azimuth` in radians, degrees or hundredths of degrees (the first whose
/// turn, 6.28, 360 or 36000, holds all values), or else by the directions seen from there.
/// @param name of the file, for messages
/// @throws IoError where neither field nor elevations show rings, or azimuths are of an unknown unit
ScanStructure ringsOf(const Geometry& geometry, const std::string& name);

}  // namespace tufted
