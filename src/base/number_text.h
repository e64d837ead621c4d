#pragma once

#include <cstdio>
#include <string>

namespace tufted {

/// A number with 6 digits, for messages; std::to_string would print a small tolerance as 0.000000.
inline std::string numberText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace tufted
