#include <limits>
#include <optional>

#include "io/columns.h"
#include "io/errors.h"
#include "io/field_names.h"
#include "io/formats.h"
#include "io/line_scanner.h"
#include "io/off_binary.h"
#include "io/polygon_soup.h"
#include "io/unread.h"
#include "io/vertex_colors.h"

namespace tufted::io {
namespace {

constexpr LineScanner::Syntax off_syntax = {.comment = '#', .comment_anywhere = true};

/// The first word of a file: the keyword and, if no blank separates them as in ModelNet40, the number of vertices.
struct FirstWord {
  OffLayout layout;
  std::string_view count;
};

std::optional<FirstWord> parseFirstWord(std::string_view word) {
  FirstWord first;
  const bool is_small = lower(word) == word;  // but not nOFF, points of n dimensions
  const auto take = [&](std::string_view prefix) {
    const bool found = word.starts_with(is_small ? lower(prefix) : std::string(prefix));
    if (found) word.remove_prefix(prefix.size());
    return found;
  };
  first.layout.texture = take("ST");
  first.layout.colors = take("C");
  first.layout.normals = take("N");
  first.layout.homogeneous = take("4");
  if (!take("OFF") || word.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  first.count = word;
  return first;
}

/// Reads the ascii form, one vertex or face per line. Not by CGAL 5.5, which reads beyond its buffer if a COFF vertex
/// has no colour.
class AsciiOff {
 public:
  AsciiOff(const std::filesystem::path& path, std::string_view text, LineScanner& scanner, const FirstWord& word,
           const Progress& progress)
      : path_(path), text_(text), scanner_(scanner), word_(word), layout_(word.layout), progress_(progress) {}

  Geometry read() {
    readCounts();
    Geometry geometry;
    geometry.width = static_cast<int>(vertices_);
    geometry.points.resize(vertices_, 3);
    if (layout_.normals) geometry.normals.resize(vertices_, 3);
    for (std::int64_t v = 0; v < vertices_; ++v) readVertex(v, geometry);
    if (!colors_.moveTo(geometry.fields, true))
      geometry.notes.push_back(path_.string() + ": " + std::to_string(colors_.given()) + " of " +
                               std::to_string(vertices_) +
                               " vertices have a colour of three or four values, so none is kept");
    PolygonSoup soup;
    soup.reserve(faces_);
    for (std::int64_t f = 0; f < faces_; ++f) readFace(soup);
    noteUnreadLines(path_, text_, scanner_, geometry);
    setPolygons(path_, soup, progress_, geometry);
    return geometry;
  }

 private:
  /// Reads the counts, which begin in the keyword's word, after it or in the next line.
  void readCounts() {
    std::size_t faces = word_.count.empty() ? 2 : 1;
    if (scanner_.tokens().size() == 1 && word_.count.empty()) {
      if (!scanner_.next()) scanner_.refuse("ends after the keyword");
      faces = 1;
    }
    if (scanner_.tokens().size() <= faces) scanner_.refuse("the numbers of vertices and faces expected");
    vertices_ = word_.count.empty() ? scanner_.integer(faces - 1) : scanner_.integerOf(word_.count);
    faces_ = scanner_.integer(faces);
    constexpr std::int64_t most = std::numeric_limits<int>::max();
    if (vertices_ < 0 || faces_ < 0 || vertices_ > most || faces_ > most)
      scanner_.refuse("the numbers of vertices and faces are not in [0, 2^31)");
    // A vertex takes at least "0 0 0\n", a face at least "0\n".
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
    // Files without C in their keyword may have colours too.
    if (!layout_.texture) colors_.add(scanner_, layout_.behindNormal());
    if (!layout_.normals) return;
    for (int c = 0; c < 3; ++c) geometry.normals(v, c) = scanner_.number(layout_.normal() + c);
  }

  /// Reads the number of corners and the corners; a colour after them is ignored.
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
    soup.add(std::move(polygon), scanner_.line());
  }

  const std::filesystem::path& path_;
  std::string_view text_;
  LineScanner& scanner_;
  FirstWord word_;
  OffLayout layout_;
  const Progress& progress_;
  VertexColors colors_;
  std::int64_t vertices_ = 0;
  std::int64_t faces_ = 0;
};

}  // namespace

bool looksLikeOff(std::string_view bytes) {
  const auto tokens = firstTokens(bytes, off_syntax);
  return !tokens.empty() && parseFirstWord(tokens[0]).has_value();
}

Geometry readOff(const std::filesystem::path& path, std::string_view text, const Progress& progress) {
  LineScanner scanner(path, text, off_syntax);
  const auto word = scanner.next() ? parseFirstWord(scanner.tokens()[0]) : std::nullopt;
  if (!word) scanner.refuse("the header does not begin with OFF, COFF, NOFF, STOFF or 4OFF");
  const bool binary = scanner.tokens().size() > 1 && lower(scanner.tokens()[1]) == "binary";
  Geometry geometry = binary ? readBinaryOff(path, text, scanner.offset(), word->layout, progress)
                             : AsciiOff(path, text, scanner, *word, progress).read();
  if (!binary) geometry.format = "OFF, ascii";
  return geometry;
}

}  // namespace tufted::io
