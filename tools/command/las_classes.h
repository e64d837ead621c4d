#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tufted/io/read.h"

/// A class of the points of a LAS file.
struct LasClass {
  int number = 0;           ///< value of the field `classification`
  std::string name;         ///< in the LAS specification
  std::int64_t points = 0;  ///< number of points
};

/// The classes that points of a LAS file have, by ascending number; none for other files.
std::vector<LasClass> lasClasses(const tufted::Geometry& geometry);

/// Name of the coordinate reference system of a LAS file: that of its WKT, or the EPSG code or citation of its GeoTIFF
/// keys. Empty if there is none.
std::string lasReferenceSystem(const tufted::Geometry& geometry);
