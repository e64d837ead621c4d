#include <limits>

#include "io/columns.h"
#include "io/errors.h"
#include "io/file_text.h"
#include "io/formats.h"
#include "io/line_scanner.h"
#include "io/polygon_soup.h"

namespace tufted::io {
namespace {

/// The vertex of a corner `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 0. Negative numbers count back from the
/// last vertex so far.
int cornerVertex(const LineScanner& scanner, std::size_t token, std::int64_t vertices) {
  const std::int64_t number = scanner.integerBefore(token, '/');
  if (number == 0) scanner.refuse("vertices are counted from 1, here is 0");
  const std::int64_t vertex = number > 0 ? number - 1 : vertices + number;
  if (vertex < 0 || vertex > std::numeric_limits<int>::max())
    scanner.refuse("no vertex " + quote(scanner.tokens()[token]));
  return static_cast<int>(vertex);
}

}  // namespace

// CGAL 5.5 reads OBJ too, but loses the faces of files that separate corners by tabs, cuts a face short at a token it
// cannot read, and refuses files with lines (`l`) or continued lines.
Geometry readObj(const std::filesystem::path& path) {
  const std::string text = readBytes(path);
  LineScanner scanner(path, text, {.comment = '#', .continued = true});
  std::vector<double> coordinates;
  PolygonSoup soup;
  while (scanner.next()) {
    const auto& tokens = scanner.tokens();
    if (tokens[0] == "v") {
      if (tokens.size() < 4) scanner.refuse("three coordinates expected");
      for (std::size_t t = 1; t <= 3; ++t) coordinates.push_back(scanner.number(t));
    } else if (tokens[0] == "f") {
      std::vector<int>& polygon = soup.polygons.emplace_back();
      soup.places.push_back(scanner.line());
      const auto vertices = static_cast<std::int64_t>(coordinates.size() / 3);
      for (std::size_t t = 1; t < tokens.size(); ++t) polygon.push_back(cornerVertex(scanner, t, vertices));
    }
  }
  if (coordinates.empty()) refuse(path, "holds no vertices");
  Geometry geometry;
  geometry.width = static_cast<int>(checkedRows(path, static_cast<std::int64_t>(coordinates.size() / 3)));
  geometry.points = Eigen::Map<const Points>(coordinates.data(), geometry.width, 3);
  setPolygons(path, soup, geometry);
  return geometry;
}

}  // namespace tufted::io
