#pragma once

#include <cstdio>
#include <string>

namespace tufted {

/// A number as messages show it: std::to_string makes 0.000000 of a tolerance.
inline std::string numberText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace tufted
