#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "base/buffer.h"
#include "base/median.h"

namespace tufted {

/// The caller's numbers of the rows, or of the columns, of an image that hold points, ascending.
using PixelLines = Buffer<std::int64_t>;

/// The median difference of consecutive numbers; 1 for a single line.
inline double medianStep(const PixelLines& lines) {
  Buffer<double> steps;
  for (std::size_t i = 1; i < lines.size(); ++i) steps.push_back(static_cast<double>(lines[i] - lines[i - 1]));
  return steps.empty() ? 1 : medianOf(std::move(steps));
}

/// Whether the median steps of rows and columns differ too much for windows of a few lines each way.
inline bool isStretched(const PixelLines& rows, const PixelLines& columns) {
  // Greatest ratio of the two steps. An exact ball of area 6.9 has 6.2 as an image and 6.3 by the tree with 12, 7.8 and
  // 6.6 with 14.
  constexpr double most_stretch = 12;
  const double stretch = medianStep(rows) / medianStep(columns);
  return stretch > most_stretch || 1 / stretch > most_stretch;
}

/// The share of an image's surface that is sparse: around which fewer than half of the other pixels of 5 x 5 hold
/// points as well, from samples. Rows and columns without points are not counted as missing, unless the lines are
/// stretched, see isStretched(). 0 without points.
/// @param holds holds(i, j): whether the pixel of (rows[i], columns[j]) holds a point
template <class Holds>
double sparseShare(const PixelLines& rows, const PixelLines& columns, const Holds& holds) {
  constexpr std::int64_t samples = 1 << 15;  // number of sampled pixels
  constexpr int reach = 2;                   // lines on each side: windows of 5 x 5 hold most stars
  const bool counts_missing = isStretched(rows, columns);
  const auto height = static_cast<int>(rows.size()), width = static_cast<int>(columns.size());
  // The range of the lines with points that are at most `reach` away from `line`.
  const auto around = [counts_missing](const PixelLines& lines, int line) {
    const auto isNear = [&](int other) { return !counts_missing || std::abs(lines[other] - lines[line]) <= reach; };
    int begin = std::max(0, line - reach), end = std::min(static_cast<int>(lines.size()), line + reach + 1);
    while (!isNear(begin)) ++begin;
    while (!isNear(end - 1)) --end;
    return std::pair(begin, end);
  };
  // How many lines of the image are at most `reach` away.
  const auto countAround = [&](const PixelLines& lines, int line, const std::pair<int, int>& held) {
    if (!counts_missing) return std::int64_t{held.second} - held.first;
    return std::min(lines.back(), lines[line] + reach) - std::max(lines.front(), lines[line] - reach) + 1;
  };
  const std::int64_t pixels = std::int64_t{height} * width;
  std::int64_t stride = std::max<std::int64_t>(1, pixels / samples);
  while (std::gcd(stride, width) > 1) ++stride;  // samples then lie in all columns
  double surface = 0, sparse = 0;                // in pixels, a part of the window for each of its points
  for (std::int64_t i = 0; i < pixels; i += stride) {
    const int row = static_cast<int>(i / width), column = static_cast<int>(i % width);
    if (!holds(row, column)) continue;
    const auto in_rows = around(rows, row), in_columns = around(columns, column);
    const std::int64_t window = countAround(rows, row, in_rows) * countAround(columns, column, in_columns);
    std::int64_t held = 0;
    for (int r = in_rows.first; r < in_rows.second; ++r)
      for (int c = in_columns.first; c < in_columns.second; ++c) held += holds(r, c) ? 1 : 0;
    const double spread = static_cast<double>(window) / static_cast<double>(held);
    surface += spread;
    if (2 * (held - 1) < window - 1) sparse += spread;
  }
  return surface > 0 ? sparse / surface : 0;
}

}  // namespace tufted
