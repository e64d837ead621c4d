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

  void add(std::vector<int> polygon, std::int64_t place);
  /// Adds the triangles of a strip, every other one turned over; -1 begins a new strip. Triangles with a repeated
  /// vertex only lead from one part of a strip to the next.
  void addStrip(const std::vector<int>& strip, std::int64_t place);

  /// Makes room for more polygons, for which the file was found to be long enough.
  void reserve(std::int64_t count) {
    polygons.reserve(polygons.size() + static_cast<std::size_t>(count));
    places.reserve(places.size() + static_cast<std::size_t>(count));
  }
};

/// Makes `geometry` a mesh of the triangulated polygons; with no polygon it stays a cloud.
/// @throws IoError for an index outside [0, points.rows())
/// @throws Cancelled when `progress` returns false
void setPolygons(const std::filesystem::path& path, const PolygonSoup& soup, const Progress& progress,
                 Geometry& geometry);

}  // namespace tufted::io
