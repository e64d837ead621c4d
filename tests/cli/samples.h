#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

// Contents of files, and helpers for tests of the command.

inline const char* const tetrahedron = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

/// N points of the unit sphere.
inline std::string sphere(int points) {
  std::mt19937_64 generator(1);
  const auto uniform = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  std::string text;
  for (int i = 0; i < points; ++i) {
    const double z = 2 * uniform() - 1, angle = 2 * M_PI * uniform(), r = std::sqrt(1 - z * z);
    text += std::to_string(r * std::cos(angle)) + ' ' + std::to_string(r * std::sin(angle)) + ' ' + std::to_string(z) +
            '\n';
  }
  return text;
}

inline bool isOneLine(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n') == 1;
}

inline std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
