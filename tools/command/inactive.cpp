#include "inactive.h"

#include <algorithm>
#include <array>
#include <cstdio>

std::string nothingActive(const tufted::Laplacian& laplacian) {
  std::array<std::size_t, 4> count = {};  // by PointStatus
  for (const tufted::PointStatus status : laplacian.status) ++count[static_cast<std::size_t>(status)];
  if (count[0] > 0) return "";
  if (laplacian.status.empty()) return "no point is active, there are none";
  return "no point is active: " + std::to_string(count[1]) + " not finite, " + std::to_string(count[2]) +
         " coincident, " + std::to_string(count[3]) + " isolated";
}

void warn(ProgressBar& bar, const std::string& line) {
  bar.clear();
  std::string text = "tufted: " + line;
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::fprintf(stderr, "%s\n", text.c_str());
}
