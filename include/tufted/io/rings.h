#pragma once

#include <string>

#include "tufted/io/read.h"
#include "tufted/scan_structure.h"

namespace tufted {

/// Finds the rings of a spinning scanner in a file's points. Ring numbers are those of the field `ring`, otherwise
/// clusters of the elevations seen from the file's viewpoint (findRings()). Azimuths are those of the field `azimuth`,
/// in radians, degrees or hundredths of degrees, the first whose full turn (6.28, 360 or 36000) covers all values;
/// otherwise the directions seen from there.
/// @param name of the file, for messages
/// @return one entry per point, with the position of the sensor
/// @throws IoError if there is no field `ring` and elevations show no rings, or if azimuths have none of these units
ScanStructure ringsOf(const Geometry& geometry, const std::string& name);

}  // namespace tufted
