#include <limits>
#include <optional>

#include "io/columns.h"
#include "io/errors.h"
#include "io/formats.h"
#include "io/line_scanner.h"
#include "io/off_binary.h"
#include "io/off_layout.h"
#include "io/polygon_soup.h"
#include "io/vertex_colors.h"

namespace tufted::io {
namespace {

constexpr LineScanner::Syntax syntax = {.comment = '#', .comment_anywhere = true};

std::optional<OffLayout> parseKeyword(std::string_view word) {
  OffLayout layout;
  const auto take = [&word](std::string_view prefix) {
    const bool found = word.starts_with(prefix);
    if (found) word.remove_prefix(prefix.size());
    return found;
  };
  layout.texture = take("ST");
  layout.colors = take("C");
  layout.normals = take("N");
  layout.homogeneous = take("4");
  if (word != "OFF") return std::nullopt;
  return layout;
}

/// Reads the ascii form, one vertex or face per line. CGAL 5.5 reads beyond its buffer where a COFF vertex has no
/// colour.
class AsciiOff {
 public:
  AsciiOff(const std::filesystem::path& path, std::string_view text, LineScanner& scanner, OffLayout layout,
           const Progress& progress)
      : path_(path), text_(text), scanner_(scanner), layout_(layout), progress_(progress) {}

  Geometry read() {
    readCounts();
    Geometry geometry;
    geometry.width = static_cast<int>(vertices_);
    geometry.points.resize(vertices_, 3);
    if (layout_.normals) geometry.normals.resize(vertices_, 3);
    for (std::int64_t v = 0; v < vertices_; ++v) readVertex(v, geometry);
    colors_.moveTo(geometry.fields, true);
    PolygonSoup soup;
    soup.reserve(faces_);
    for (std::int64_t f = 0; f < faces_; ++f) readFace(soup);
    // What follows is passed over, as other readers do: CGAL's prim.off has a face more than its header counts.
    setPolygons(path_, soup, progress_, geometry);
    return geometry;
  }

 private:
  /// Reads the counts, which stand behind the keyword or in the next line.
  void readCounts() {
    std::size_t first = 1;
    if (scanner_.tokens().size() == 1) {
      if (!scanner_.next()) scanner_.refuse("ends after the keyword");
      first = 0;
    }
    if (scanner_.tokens().size() < first + 2) scanner_.refuse("the numbers of vertices and faces expected");
    vertices_ = scanner_.integer(first);
    faces_ = scanner_.integer(first + 1);
    constexpr std::int64_t most = std::numeric_limits<int>::max();
    if (vertices_ < 0 || faces_ < 0 || vertices_ > most || faces_ > most)
      scanner_.refuse("the numbers of vertices and faces are not in [0, 2^31)");
    // The shortest vertex is "0 0 0\n", the shortest face "0\n".
    if (static_cast<std::uint64_t>(vertices_ * 6 + faces_ * 2) > text_.size())
      scanner_.refuse("too short for the " + std::to_string(vertices_) + " vertices and " + std::to_string(faces_) +
                      " faces of its header");
  }

  void readVertex(std::int64_t v, Geometry& geometry) {
    if (!scanner_.next())
      scanner_.refuse("ends after " + std::to_string(v) + " of " + std::to_string(vertices_) + " vertices");
    if (scanner_.tokens().size() < layout_.behindNormal())
      scanner_.refuse(std::to_string(layout_.behindNormal()) + " values expected for a vertex");
    const double w = layout_.homogeneous ? scanner_.number(3) : 1;
    for (int c = 0; c < 3; ++c) geometry.points(v, c) = scanner_.number(c) / w;
    // Colours also stand behind the coordinates of a plain OFF.
    if (!layout_.texture) colors_.add(scanner_, layout_.behindNormal());
    if (!layout_.normals) return;
    for (int c = 0; c < 3; ++c) geometry.normals(v, c) = scanner_.number(layout_.normal() + c);
  }

  /// The number of corners, the corners, perhaps a colour.
  void readFace(PolygonSoup& soup) {
    if (!scanner_.next())
      scanner_.refuse("ends after " + std::to_string(soup.polygons.size()) + " of " + std::to_string(faces_) +
                      " faces");
    const std::int64_t corners = scanner_.integer(0);
    if (corners < 0 || corners >= static_cast<std::int64_t>(scanner_.tokens().size()))
      scanner_.refuse(quote(scanner_.tokens()[0]) + " corners expected");
    std::vector<int> polygon(corners);
    for (std::int64_t c = 0; c < corners; ++c) {
      const std::int64_t vertex = scanner_.integer(c + 1);
      if (vertex < 0 || vertex >= vertices_) scanner_.refuse("no vertex " + std::to_string(vertex));
      polygon[c] = static_cast<int>(vertex);
    }
    soup.polygons.push_back(std::move(polygon));
    soup.places.push_back(scanner_.line());
  }

  const std::filesystem::path& path_;
  std::string_view text_;
  LineScanner& scanner_;
  OffLayout layout_;
  const Progress& progress_;
  VertexColors colors_;
  std::int64_t vertices_ = 0;
  std::int64_t faces_ = 0;
};

}  // namespace

bool looksLikeOff(std::string_view bytes) {
  const auto tokens = firstTokens(bytes, syntax);
  return !tokens.empty() && parseKeyword(tokens[0]).has_value();
}

Geometry readOff(const std::filesystem::path& path, std::string_view text, const Progress& progress) {
  LineScanner scanner(path, text, syntax);
  const auto layout = scanner.next() ? parseKeyword(scanner.tokens()[0]) : std::nullopt;
  if (!layout) scanner.refuse("the header does not begin with OFF, COFF, NOFF, STOFF or 4OFF");
  const bool binary = scanner.tokens().size() > 1 && scanner.tokens()[1] == "BINARY";
  Geometry geometry = binary ? readBinaryOff(path, text, scanner.offset(), *layout, progress)
                             : AsciiOff(path, text, scanner, *layout, progress).read();
  geometry.format = binary ? "OFF, binary" : "OFF, ascii";
  return geometry;
}

}  // namespace tufted::io
