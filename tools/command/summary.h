#pragma once

#include <cstdarg>
#include <string>
#include <vector>

/// Lines for people, each with a name and a text.
class Summary {
 public:
  [[gnu::format(printf, 3, 4)]] void add(const char* name, const char* format, ...);
  /// Adds a line that only --verbose shows.
  [[gnu::format(printf, 3, 4)]] void addDetail(const char* name, const char* format, ...);
  /// Adds all lines of another summary.
  void append(const Summary& next);

  std::string text(bool with_details) const;

 private:
  struct Line {
    std::string text;
    bool is_detail;
  };
  void addLine(bool is_detail, const char* name, const char* format, std::va_list values);

  std::vector<Line> lines_;
};
