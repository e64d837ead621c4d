#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "io/columns.h"
#include "io/errors.h"
#include "io/field_names.h"
#include "io/formats.h"
#include "io/number.h"
#include "io/polygon_soup.h"
#include "io/unread.h"
#include "io/vtk_body.h"

// Reads polygonal data in VTK's legacy format, versions 1 to 5 (VTK User's Guide, "Simple Legacy Formats"), as PCL's
// tools write it. Not by VTK, which is larger than all other dependencies together.
namespace tufted::io {
namespace {

/// Replaces codes such as %20, which VTK writes for a blank in a name.
std::string decoded(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    unsigned code = 0;
    const char* const digits = name.data() + i + 1;
    const bool is_code =
        name[i] == '%' && i + 2 < name.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
    text += is_code ? static_cast<char>(code) : name[i];
    if (is_code) i += 2;
  }
  return text;
}

class VtkReader {
 public:
  VtkReader(const std::filesystem::path& path, std::string_view bytes, const Progress& progress)
      : path_(path), bytes_(bytes), body_(path, bytes), progress_(progress) {}

  Geometry read() {
    readHeader();
    bool goes_on = false;
    while (!goes_on && body_.next()) goes_on = !readSection();
    if (columns_.fields.empty()) body_.refuse("has no POINTS");
    nameColumns(path_, 1, columns_.fields);
    Geometry geometry = toGeometry(std::move(columns_));
    geometry.format = std::string("VTK, ") + (body_.isBinary() ? "binary" : "ascii");
    if (goes_on) noteUnread(path_, bytes_, body_.begin(), geometry);
    setPolygons(path_, soup_, progress_, geometry);
    return geometry;
  }

 private:
  void readHeader() {
    body_.next();
    std::string_view number = body_.word(body_.words() - 1);
    int major = 0;
    if (!looksLikeVtk(bytes_) || !parseNumber(number.substr(0, number.find('.')), major))
      body_.refuse("does not begin with '# vtk DataFile Version'");
    has_offsets_ = major >= 5;
    body_.takeLine();  // the title
    body_.next();
    const std::string form = body_.keyword(0);
    if (form != "ascii" && form != "binary") body_.refuse("is neither ASCII nor BINARY");
    body_.setBinary(form == "binary");
    if (!body_.next() || body_.keyword(0) != "dataset") body_.refuse("DATASET expected");
    if (body_.keyword(1) != "polydata")
      body_.refuse("holds the dataset " + quote(body_.word(1)) +
                   ", must be POLYDATA; ParaView's filter Extract Surface " +
                   "makes it, and saves it as PLY or STL as well");
  }

  /// Reads a section. Returns false if the current line begins none.
  bool readSection() {
    const std::string word = body_.keyword(0);
    if (word == "points") {
      if (!columns_.fields.empty()) body_.refuse("POINTS a second time");
      rows_ = columns_.rows = body_.count(1);
      addColumns(body_.values("xyz", body_.type(2), rows_, 3));
    } else if (isOneOf(word, {"vertices", "lines", "polygons", "triangle_strips"})) {
      readCells(word);
    } else if (word == "point_data" || word == "cell_data") {
      tuples_ = body_.count(1);
      are_of_points_ = word == "point_data";
      if (are_of_points_ && tuples_ != rows_)
        body_.refuse("values of " + std::to_string(tuples_) + " points, of which there are " + std::to_string(rows_));
    } else if (word == "metadata") {
      while (!body_.atBlankLine()) body_.takeLine();
    } else if (word == "field") {
      for (std::int64_t array = body_.count(2); array > 0; --array) {
        if (!body_.next()) body_.refuse("ends inside a FIELD");
        if (body_.keyword(0) == "metadata") {
          while (!body_.atBlankLine()) body_.takeLine();
          ++array;
          continue;
        }
        const std::string name = decoded(body_.word(0));
        const std::int64_t values = body_.count(1), tuples = body_.count(2);
        keep(body_.values(name, body_.type(3), tuples, values), tuples);
      }
    } else {
      return readAttribute(word);
    }
    return true;
  }

  bool readAttribute(const std::string& word) {
    if (word == "scalars") {
      const std::string name = decoded(body_.word(1));
      const FieldType type = body_.type(2);
      const std::int64_t values = body_.words() > 3 ? body_.count(3) : 1;
      if (!body_.next() || body_.keyword(0) != "lookup_table") body_.refuse("LOOKUP_TABLE expected");
      keep(body_.values(name, type, tuples_, values), tuples_);
    } else if (word == "color_scalars") {
      readColors(body_.count(2));
    } else if (word == "lookup_table") {
      body_.values("", body_.isBinary() ? FieldType::uint8 : FieldType::float32, body_.count(2), 4);
    } else if (word == "normals") {
      keep(body_.values("normals", body_.type(2), tuples_, 3), tuples_);
    } else if (word == "vectors") {
      const std::string name = decoded(body_.word(1));
      keep(body_.values(name, body_.type(2), tuples_, 3), tuples_);
    } else if (word == "texture_coordinates") {
      const std::string name = decoded(body_.word(1));
      keep(body_.values(name, body_.type(3), tuples_, body_.count(2)), tuples_);
    } else if (word == "tensors" || word == "tensors6") {
      const std::string name = decoded(body_.word(1));
      keep(body_.values(name, body_.type(2), tuples_, word == "tensors" ? 9 : 6), tuples_);
    } else if (word == "global_ids" || word == "pedigree_ids") {
      const std::string name = decoded(body_.word(1));
      keep(body_.values(name, body_.type(2), tuples_, 1), tuples_);
    } else {
      // An unknown word may begin a section with values, so it is refused; other bytes follow the last section.
      const bool is_word =
          std::all_of(word.begin(), word.end(), [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; });
      if (is_word) body_.refuse("unknown word " + quote(body_.word(0)));
      return false;
    }
    return true;
  }

  /// Reads colours: bytes in a binary file, numbers from 0 to 1 in text.
  void readColors(std::int64_t channels) {
    const Field given = body_.values("", body_.isBinary() ? FieldType::uint8 : FieldType::float32, tuples_, channels);
    Field colors = {"rgba", FieldType::uint8, static_cast<int>(channels), {}};
    for (std::size_t i = 0; i < static_cast<std::size_t>(tuples_ * channels); ++i) {
      const double value = tufted::valueOf(given, i) * (body_.isBinary() ? 1 : 255);
      colors.bytes.push_back(
          static_cast<std::byte>(std::isfinite(value) ? std::clamp(std::round(value), 0.0, 255.0) : 0));
    }
    keep(std::move(colors), tuples_);
  }

  /// Keeps values if they are per point; values per cell are dropped.
  void keep(Field field, std::int64_t tuples) {
    if (are_of_points_ && tuples == rows_) addColumns(std::move(field));
  }

  /// Adds a field, or its columns one by one if they have known names: xyz, normals, colours.
  void addColumns(Field field) {
    const std::vector<std::string> names = partNames(field.name, static_cast<std::size_t>(field.count));
    if (names.empty()) {
      columns_.fields.push_back(std::move(field));
      return;
    }
    const std::size_t size = sizeOf(field.type), count = static_cast<std::size_t>(field.count);
    for (std::size_t c = 0; c < count; ++c) {
      Field part = {names[c], field.type, 1, {}};
      part.bytes.resize(static_cast<std::size_t>(rows_) * size);
      for (std::size_t i = 0; i < static_cast<std::size_t>(rows_); ++i)
        std::memcpy(part.bytes.data() + i * size, field.bytes.data() + (i * count + c) * size, size);
      columns_.fields.push_back(std::move(part));
    }
  }

  /// Reads cells. Until version 4 each is a number of corners and the corners; in version 5 there are offsets into a
  /// list of all corners.
  void readCells(const std::string& word) {
    const std::int64_t first = body_.count(1), second = body_.count(2);
    const auto place = static_cast<std::int64_t>(body_.begin());
    std::vector<std::int64_t> offsets = {0}, corners;
    if (has_offsets_) {
      offsets = readNamed("offsets", first);
      corners = readNamed("connectivity", second);
    } else {
      const std::vector<std::int64_t> all = body_.integers(FieldType::int32, second);
      for (std::size_t at = 0; at < all.size();) {
        const std::int64_t length = all[at++];
        if (length < 0 || length > std::ssize(all) - static_cast<std::int64_t>(at))
          body_.refuse("a cell of " + std::to_string(length) + " corners");
        corners.insert(corners.end(), all.begin() + static_cast<std::ptrdiff_t>(at),
                       all.begin() + static_cast<std::ptrdiff_t>(at) + length);
        at += static_cast<std::size_t>(length);
        offsets.push_back(std::ssize(corners));
      }
      if (std::ssize(offsets) != first + 1)
        body_.refuse(std::to_string(first) + " cells expected, here are " + std::to_string(offsets.size() - 1));
    }
    if (word != "polygons" && word != "triangle_strips") return;
    soup_.place_name = "byte";
    for (std::size_t cell = 0; cell + 1 < offsets.size(); ++cell) {
      if (offsets[cell] < 0 || offsets[cell + 1] < offsets[cell] || offsets[cell + 1] > std::ssize(corners))
        body_.refuse("offsets of cells that do not ascend");
      std::vector<int> polygon;
      for (std::int64_t c = offsets[cell]; c < offsets[cell + 1]; ++c) {
        const std::int64_t vertex = corners[static_cast<std::size_t>(c)];
        if (vertex < 0 || vertex >= rows_) body_.refuse("no vertex " + std::to_string(vertex));
        polygon.push_back(static_cast<int>(vertex));
      }
      if (word == "polygons")
        soup_.add(std::move(polygon), place);
      else
        soup_.addStrip(polygon, place);
    }
  }

  std::vector<std::int64_t> readNamed(const char* name, std::int64_t number) {
    if (!body_.next() || body_.keyword(0) != name) body_.refuse(std::string(name) + " expected");
    return body_.integers(body_.type(1), number);
  }

  const std::filesystem::path& path_;
  std::string_view bytes_;
  VtkBody body_;
  const Progress& progress_;
  bool has_offsets_ = false;
  std::int64_t rows_ = 0;
  std::int64_t tuples_ = 0;     ///< number of tuples of the attributes that follow
  bool are_of_points_ = false;  ///< whether these attributes are per point
  Columns columns_;
  PolygonSoup soup_;
};

}  // namespace

bool looksLikeVtk(std::string_view bytes) {
  return lower(bytes.substr(0, 14)) == "# vtk datafile";
}

Geometry readVtk(const std::filesystem::path& path, std::string_view bytes, const Progress& progress) {
  return VtkReader(path, bytes, progress).read();
}

}  // namespace tufted::io
