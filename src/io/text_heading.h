#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tufted::io {

/// What stands above the numbers of a text in columns: blank lines, comments, a number of points, a line of names.
struct TextHeading {
  std::vector<std::string> names;     ///< of the columns; empty where there are none
  bool is_comment = false;            ///< the names stand in a comment, as CloudCompare and numpy write them
  bool may_lack_index = false;        ///< rows may begin with a value that has no name, as R and pandas write them
  std::int64_t line = 1;              ///< of the names
  std::optional<std::int64_t> count;  ///< of points, where it stands above the names
  std::size_t end = 0;                ///< where the line behind the names begins; 0 without a line of names alone
  std::int64_t lines = 0;             ///< lines before it
};

/// Reads the heading. A comment counts as one of names only if x, y and z are among them.
TextHeading readHeading(std::string_view text);

/// Whether x, y and z are among the names, as nameFields() knows them.
bool namePoints(const std::vector<std::string>& names);

}  // namespace tufted::io
