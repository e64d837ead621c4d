#include "io/pcd_header.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>

#include "io/errors.h"
#include "io/field_names.h"
#include "io/line_scanner.h"
#include "io/pose.h"

namespace tufted::io {
namespace {

class PcdHeaderParser {
 public:
  PcdHeaderParser(const std::filesystem::path& path, std::string_view text) : scanner_(path, text, {.comment = '#'}) {}

  PcdHeader parse() {
    while (scanner_.next()) {
      if (scanner_.isCutOff() && lower(scanner_.tokens()[0]) != "data")
        scanner_.refuse("the file ends within the header");
      if (keyword()) return finish();
    }
    scanner_.refuse("the header has no DATA line");
  }

 private:
  /// Parses a line. Returns true at DATA, which ends the header.
  bool keyword() {
    const auto& tokens = scanner_.tokens();
    const std::string word = lower(tokens[0]);
    if (word == "fields" || word == "columns") {
      if (tokens.size() < 2) scanner_.refuse("no fields");
      if (!names_.empty()) scanner_.refuse("a second list of fields");
      for (std::size_t t = 1; t < tokens.size(); ++t) names_.emplace_back(tokens[t]);
    } else if (word == "size") {
      sizes_ = perField();
    } else if (word == "count") {
      counts_ = perField();
    } else if (word == "type") {
      if (tokens.size() != names_.size() + 1) scanner_.refuse("TYPE does not name as many fields as FIELDS");
      for (std::size_t t = 1; t < tokens.size(); ++t)
        kinds_ += static_cast<char>(std::tolower(static_cast<unsigned char>(tokens[t][0])));
    } else if (word == "width") {
      width_ = single();
    } else if (word == "height") {
      height_ = single();
    } else if (word == "points") {
      points_ = single();
    } else if (word == "data") {
      data();
      return true;
    } else if (word == "viewpoint") {
      if (tokens.size() != header_.viewpoint.size() + 1) scanner_.refuse("seven numbers expected");
      for (std::size_t t = 1; t < tokens.size(); ++t) header_.viewpoint[t - 1] = scanner_.number(t);
      if (const char* const fault = poseFault(header_.viewpoint)) scanner_.refuse(fault);
    } else if (word != "version") {
      scanner_.refuse("unknown keyword " + quote(tokens[0]));
    }
    return false;
  }

  std::vector<std::int64_t> perField() const {
    if (scanner_.tokens().size() != names_.size() + 1)
      scanner_.refuse(std::string(scanner_.tokens()[0]) + " does not name as many fields as FIELDS");
    std::vector<std::int64_t> values;
    for (std::size_t t = 1; t < scanner_.tokens().size(); ++t) {
      values.push_back(scanner_.integer(t));
      if (values.back() < 1 || values.back() > 1'000'000)
        scanner_.refuse("out of range: " + quote(scanner_.tokens()[t]));
    }
    return values;
  }

  std::int64_t single() const {
    if (scanner_.tokens().size() != 2) scanner_.refuse("one number expected");
    const std::int64_t value = scanner_.integer(1);
    if (value < 0) scanner_.refuse("negative: " + quote(scanner_.tokens()[1]));
    checkRows(value);
    return value;
  }

  void checkRows(std::int64_t rows) const {
    if (rows > std::numeric_limits<int>::max())
      scanner_.refuse(std::to_string(rows) + " points are more than 2^31 - 1");
  }

  void data() {
    const std::string kind = scanner_.tokens().size() == 2 ? lower(scanner_.tokens()[1]) : "";
    constexpr const char* names[] = {"ascii", "binary", "binary_compressed"};
    const auto name = std::find(std::begin(names), std::end(names), kind);
    if (name == std::end(names)) scanner_.refuse("DATA is none of ascii, binary, binary_compressed");
    header_.data = static_cast<PcdHeader::Data>(name - names);
  }

  PcdHeader finish() {
    if (names_.empty()) scanner_.refuse("the header has no FIELDS line");
    // In old files SIZE, TYPE and COUNT may be missing, and each field is a float.
    if (sizes_.empty()) sizes_.assign(names_.size(), 4);
    if (kinds_.empty()) kinds_.assign(names_.size(), 'f');
    if (counts_.empty()) counts_.assign(names_.size(), 1);
    for (std::size_t f = 0; f < names_.size(); ++f) {
      const auto type = typeOf(kinds_[f], static_cast<std::size_t>(sizes_[f]));
      if (!type) scanner_.refuse("the field " + quote(names_[f]) + " has an unknown SIZE and TYPE");
      header_.columns.fields.push_back({names_[f], *type, static_cast<int>(counts_[f]), {}});
      header_.row_bytes += sizes_[f] * counts_[f];
      header_.row_values += counts_[f];
    }
    header_.height = height_.value_or(1);
    header_.width = width_.value_or(points_.value_or(0));
    header_.points = points_.value_or(header_.width * header_.height);
    if (header_.points != header_.width * header_.height)
      scanner_.refuse("POINTS " + std::to_string(header_.points) + " is not WIDTH " + std::to_string(header_.width) +
                      " x HEIGHT " + std::to_string(header_.height));
    checkRows(header_.points);
    header_.body = scanner_.offset();
    header_.line = scanner_.line();
    return std::move(header_);
  }

  LineScanner scanner_;
  std::vector<std::string> names_;
  std::vector<std::int64_t> sizes_, counts_;
  std::string kinds_;
  std::optional<std::int64_t> width_, height_, points_;
  PcdHeader header_;
};

}  // namespace

void allocate(PcdHeader& header) {
  header.columns.rows = header.points;
  for (Field& field : header.columns.fields)
    if (!isPadding(field)) field.bytes.resize(header.points * field.count * sizeOf(field.type));
}

PcdHeader parsePcdHeader(const std::filesystem::path& path, std::string_view text) {
  return PcdHeaderParser(path, text).parse();
}

}  // namespace tufted::io
