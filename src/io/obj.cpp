#include <algorithm>
#include <array>
#include <limits>

#include "io/columns.h"
#include "io/errors.h"
#include "io/formats.h"
#include "io/line_scanner.h"
#include "io/polygon_soup.h"
#include "io/vertex_colors.h"

namespace tufted::io {
namespace {

constexpr LineScanner::Syntax syntax = {.comment = '#', .continued = true};

// CGAL 5.5 reads OBJ too, but loses the faces of files that separate corners by tabs, cuts a face short at a token it
// cannot read, and refuses files with lines (`l`) or continued lines.
class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, std::string_view text, const Progress& progress)
      : path_(path), scanner_(path, text, syntax), progress_(progress) {}

  Geometry read() {
    while (scanner_.next()) {
      const std::string_view keyword = scanner_.tokens()[0];
      if (keyword == "v")
        readVertex();
      else if (keyword == "vn")
        readTriple(normals_);
      else if (keyword == "f")
        readFace();
    }
    if (coordinates_.empty()) scanner_.refuse("holds no vertices up to there");
    Geometry geometry;
    geometry.format = "OBJ";
    geometry.width = static_cast<int>(checkedRows(path_, vertices()));
    geometry.points = Eigen::Map<const Points>(coordinates_.data(), geometry.width, 3);
    if (normals_are_of_vertices_ && normals_.size() == coordinates_.size())
      geometry.normals = Eigen::Map<const Points>(normals_.data(), geometry.width, 3);
    colors_.moveTo(geometry.fields, false);
    setPolygons(path_, soup_, progress_, geometry);
    return geometry;
  }

 private:
  std::int64_t vertices() const { return static_cast<std::int64_t>(coordinates_.size() / 3); }

  void readTriple(std::vector<double>& values) {
    if (scanner_.tokens().size() < 4) scanner_.refuse("three coordinates expected");
    for (std::size_t t = 1; t <= 3; ++t) values.push_back(scanner_.number(t));
  }

  /// `v x y z`, with a weight that is of no use here, or with a colour as many programs write it.
  void readVertex() {
    readTriple(coordinates_);
    colors_.add(scanner_, scanner_.tokens().size() == 5 ? 5 : 4);
  }

  /// A corner is `v`, `v/vt`, `v//vn` or `v/vt/vn`. Numbers count from 1, negative ones back from the last vertex.
  void readFace() {
    std::vector<int>& polygon = soup_.polygons.emplace_back();
    soup_.places.push_back(scanner_.line());
    for (std::size_t t = 1; t < scanner_.tokens().size(); ++t) {
      const std::int64_t number = scanner_.integerBefore(t, '/');
      if (number == 0) scanner_.refuse("vertices are counted from 1, here is 0");
      const std::int64_t vertex = number > 0 ? number - 1 : vertices() + number;
      if (vertex < 0 || vertex > std::numeric_limits<int>::max())
        scanner_.refuse("no vertex " + quote(scanner_.tokens()[t]));
      polygon.push_back(static_cast<int>(vertex));
      const std::string_view corner = scanner_.tokens()[t];
      const std::string_view number_text = corner.substr(0, corner.find('/'));
      const std::size_t last = corner.rfind('/');
      // A normal belongs to the vertex only if a corner names both by the same number.
      if (last != corner.find('/') && corner.substr(last + 1) != number_text) normals_are_of_vertices_ = false;
    }
  }

  const std::filesystem::path& path_;
  LineScanner scanner_;
  const Progress& progress_;
  std::vector<double> coordinates_, normals_;
  VertexColors colors_;
  bool normals_are_of_vertices_ = true;
  PolygonSoup soup_;
};

}  // namespace

bool looksLikeObj(std::string_view bytes) {
  constexpr std::array keywords = {"v", "vn", "vt", "f", "o", "g", "mtllib", "usemtl", "s"};
  const auto tokens = firstTokens(bytes, syntax);
  return !tokens.empty() && std::find(keywords.begin(), keywords.end(), tokens[0]) != keywords.end();
}

Geometry readObj(const std::filesystem::path& path, std::string_view text, const Progress& progress) {
  return ObjReader(path, text, progress).read();
}

}  // namespace tufted::io
