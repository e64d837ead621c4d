#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tufted/io/read.h"

namespace tufted::io {

/// Polygons as read from a file, with their places in it for error messages.
struct PolygonSoup {
  Polygons polygons;
  std::vector<std::int64_t> places;  ///< line or byte of each polygon
  const char* place_name = "line";

  void add(std::vector<int> polygon, std::int64_t place);
  /// Adds the triangles of a strip, reversing every other one; -1 begins a new strip. Triangles that repeat a vertex,
  /// which only join parts of a strip, are left out.
  void addStrip(const std::vector<int>& strip, std::int64_t place);

  /// Reserves memory for `count` more polygons, once the file is known to be long enough for them.
  void reserve(std::int64_t count) {
    polygons.reserve(polygons.size() + static_cast<std::size_t>(count));
    places.reserve(places.size() + static_cast<std::size_t>(count));
  }
};

/// Triangulates the polygons and makes `geometry` a mesh of them; without polygons it stays a cloud.
/// @throws IoError for an index outside [0, points.rows())
/// @throws Cancelled when `progress` returns false
void setPolygons(const std::filesystem::path& path, const PolygonSoup& soup, const Progress& progress,
                 Geometry& geometry);

}  // namespace tufted::io
