#pragma once

#include <string>

/// Lines for standard output, of a name and what it says each.
class Summary {
 public:
  [[gnu::format(printf, 3, 4)]] void add(const char* name, const char* format, ...);
  /// @throws IoError when standard output cannot be written
  void print() const;

 private:
  std::string text_;
};
