#include "io/polygon_soup.h"

#include <algorithm>
#include <utility>

#include "io/errors.h"
#include "tufted/polygons.h"

namespace tufted::io {

void PolygonSoup::add(std::vector<int> polygon, std::int64_t place) {
  polygons.push_back(std::move(polygon));
  places.push_back(place);
}

void PolygonSoup::addStrip(const std::vector<int>& strip, std::int64_t place) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < strip.size(); ++i) {
    if (strip[i] == -1) {
      begin = i + 1;
    } else if (i >= begin + 2) {
      int a = strip[i - 2], b = strip[i - 1];
      if ((i - begin) % 2 == 1) std::swap(a, b);
      if (a != b && b != strip[i] && a != strip[i]) add({a, b, strip[i]}, place);
    }
  }
}

void setPolygons(const std::filesystem::path& path, const PolygonSoup& soup, const Progress& progress,
                 Geometry& geometry) {
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    for (const int corner : soup.polygons[p]) {
      if (corner >= 0 && corner < geometry.points.rows()) continue;
      refuse(path, std::string(soup.place_name) + " " + std::to_string(soup.places[p]) + ": a face names vertex " +
                       std::to_string(corner) + " (counted from 0) of " + std::to_string(geometry.points.rows()));
    }
  }
  geometry.is_mesh = !soup.polygons.empty();
  geometry.triangles = triangulate(geometry.points, soup.polygons, progress);
  geometry.polygons =
      std::count_if(soup.polygons.begin(), soup.polygons.end(), [](const auto& polygon) { return polygon.size() > 3; });
}

}  // namespace tufted::io
