#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tufted::io {

/// What precedes the numbers of a text in columns: blank lines, comments, a number of points, a line of names.
struct TextHeading {
  std::vector<std::string> names;     ///< names of the columns; empty: none
  bool is_comment = false;            ///< whether the names are in a comment, as CloudCompare and numpy write them
  bool may_lack_index = false;        ///< whether rows may begin with an unnamed value, as R and pandas write them
  std::int64_t line = 1;              ///< number of the line with the names
  std::optional<std::int64_t> count;  ///< number of points, if it precedes the names
  std::size_t end = 0;                ///< byte at which the line after the names begins; 0: no names outside comments
  std::int64_t lines = 0;             ///< number of lines before `end`
};

/// Reads the heading. A comment is taken for names only if x, y and z are among them.
TextHeading readHeading(std::string_view text);

/// Whether x, y and z are among the names, as nameFields() knows them.
bool namePoints(const std::vector<std::string>& names);

}  // namespace tufted::io
