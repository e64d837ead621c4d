#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tufted/io/read.h"

namespace tufted::io {

/// The corners of polygons as a file gives them, and where each was read for error messages.
struct PolygonSoup {
  Polygons polygons;
  std::vector<std::int64_t> places;  ///< line or byte per polygon
  const char* place_name = "line";
};

/// Makes `geometry` a mesh of the triangulated polygons; with no polygon it stays a cloud.
/// @throws IoError for an index outside [0, points.rows())
void setPolygons(const std::filesystem::path& path, const PolygonSoup& soup, Geometry& geometry);

}  // namespace tufted::io
