#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "io/columns.h"
#include "io/errors.h"
#include "io/field_names.h"
#include "io/formats.h"
#include "io/line_scanner.h"
#include "io/polygon_soup.h"
#include "io/vertex_colors.h"

namespace tufted::io {
namespace {

constexpr LineScanner::Syntax obj_syntax = {.comment = '#', .continued = true};

/// Keywords of lines that are skipped (Wavefront's Appendix B1, and keywords of older versions).
constexpr std::array others = {
    "vt",     "vp",       "deg",      "bmat", "step",   "cstype", "p",          "l",         "curv",  "curv2", "surf",
    "parm",   "trim",     "hole",     "scrv", "sp",     "end",    "con",        "g",         "s",     "mg",    "o",
    "bevel",  "c_interp", "d_interp", "lod",  "usemtl", "mtllib", "shadow_obj", "trace_obj", "ctech", "stech", "usemap",
    "maplib", "call",     "csh",      "bsp",  "bzp",    "cdc",    "cdp",        "res"};

// Not by CGAL 5.5, which loses the faces of files that separate corners by tabs, truncates a face at a token that it
// cannot read, and refuses files with polylines (`l`) or continued lines.
class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, std::string_view text, const Progress& progress)
      : path_(path), scanner_(path, text, obj_syntax), progress_(progress) {}

  Geometry read() {
    while (scanner_.next()) {
      const std::string keyword = lower(scanner_.tokens()[0]);
      if (keyword == "v")
        readVertex();
      else if (keyword == "vn")
        readTriple(normals_);
      else if (keyword == "f" || keyword == "fo")  // `fo` until version 3
        readFace();
      else if (std::find(others.begin(), others.end(), keyword) == others.end())
        addUnknown();
    }
    if (coordinates_.empty()) scanner_.refuse("holds no vertices up to there");
    Geometry geometry;
    geometry.format = "OBJ";
    geometry.width = static_cast<int>(checkedRows(path_, vertices()));
    geometry.points = Eigen::Map<const Points>(coordinates_.data(), geometry.width, 3);
    if (normals_are_of_vertices_ && normals_.size() == coordinates_.size())
      geometry.normals = Eigen::Map<const Points>(normals_.data(), geometry.width, 3);
    if (!colors_.moveTo(geometry.fields, false))
      note(colors_.given(), "vertices have a colour and others none, so none is kept", geometry);
    if (geometry.fields.size() == 4 && fourth_is_one_ && !last_is_one_) {  // x y z w r g b
      for (std::size_t c = 3; c > 0; --c) geometry.fields[c].name = geometry.fields[c - 1].name;
      geometry.fields.erase(geometry.fields.begin());
    }
    note(weights_, "vertices have a weight w other than 1; x y z are divided by it", geometry);
    note(unknown_,
         "lines begin with an unknown word and are not read, the first is line " + std::to_string(first_unknown_) +
             ": " + quote(unknown_word_),
         geometry);
    setPolygons(path_, soup_, progress_, geometry);
    return geometry;
  }

 private:
  std::int64_t vertices() const { return static_cast<std::int64_t>(coordinates_.size() / 3); }

  void readTriple(std::vector<double>& values) {
    if (scanner_.tokens().size() < 4) scanner_.refuse("three coordinates expected");
    for (std::size_t t = 1; t <= 3; ++t) values.push_back(scanner_.number(t));
  }

  /// Reads `v x y z`, which a weight, a colour or both may follow; many programs write colours.
  void readVertex() {
    readTriple(coordinates_);
    const std::size_t tokens = scanner_.tokens().size();
    if (tokens == 8) {
      fourth_is_one_ = fourth_is_one_ && scanner_.number(4) == 1;
      last_is_one_ = last_is_one_ && scanner_.number(7) == 1;
    }
    const bool has_weight = tokens == 5;
    if (has_weight) {
      const double weight = scanner_.number(4);
      if (weight != 1) ++weights_;
      for (std::size_t c = 1; c <= 3; ++c) coordinates_[coordinates_.size() - c] /= weight;
    }
    colors_.add(scanner_, has_weight ? 5 : 4);
  }

  void addUnknown() {
    if (unknown_++ > 0) return;
    first_unknown_ = scanner_.line();
    unknown_word_ = scanner_.tokens()[0];
  }

  void note(std::int64_t count, const std::string& what, Geometry& geometry) const {
    if (count > 0) geometry.notes.push_back(path_.string() + ": " + std::to_string(count) + " " + what);
  }

  /// Reads corners `v`, `v/vt`, `v//vn` or `v/vt/vn`. Numbers count from 1, negative ones backwards from the last
  /// vertex.
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
      // Normals are kept only if every corner has the same number for its normal as for its vertex.
      if (last != corner.find('/') && corner.substr(last + 1) != number_text) normals_are_of_vertices_ = false;
    }
  }

  const std::filesystem::path& path_;
  LineScanner scanner_;
  const Progress& progress_;
  std::vector<double> coordinates_, normals_;
  VertexColors colors_;
  bool normals_are_of_vertices_ = true;
  bool fourth_is_one_ = true, last_is_one_ = true;  // for vertices with four values after x y z
  std::int64_t weights_ = 0, unknown_ = 0, first_unknown_ = 0;
  std::string_view unknown_word_;
  PolygonSoup soup_;
};

}  // namespace

bool looksLikeObj(std::string_view bytes) {
  constexpr std::array keywords = {"v", "vn", "vt", "f", "o", "g", "mtllib", "usemtl", "s"};
  const auto tokens = firstTokens(bytes, obj_syntax);
  return !tokens.empty() && std::find(keywords.begin(), keywords.end(), lower(tokens[0])) != keywords.end();
}

Geometry readObj(const std::filesystem::path& path, std::string_view text, const Progress& progress) {
  return ObjReader(path, text, progress).read();
}

}  // namespace tufted::io
