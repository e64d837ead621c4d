#pragma once

#include <algorithm>
#include <array>
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

/// How densely an image is filled where it is sparsest. It is divided into 4 x 4 parts, and counted is, of the 5 x 5
/// pixels around a pixel that holds a point, the mean share that hold points as well, from samples. At least 0.8 for 50
/// images with a dozen holes of any size, and 1/2 if every second pixel is missing at random in one part. Rows and
/// columns without points are not counted as missing, unless the lines are stretched, see isStretched(). 0 without
/// pixels.
/// @param holds holds(i, j): whether the pixel of (rows[i], columns[j]) holds a point
template <class Holds>
double pixelFill(const PixelLines& rows, const PixelLines& columns, const Holds& holds) {
  constexpr std::int64_t samples = 1 << 15;  // number of sampled pixels: the share is off by 0.002
  constexpr int reach = 2;                   // lines on each side: windows of 5 x 5 hold most stars
  constexpr int parts = 4;                   // of the rows and of the columns
  // A part counts if it holds at least half as much of the surface as one does on average: the rims of holes alone are
  // sparse. The sparsest part of ten real images has 0.95.
  constexpr double least_share = 1. / (2 * parts * parts);
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
  struct Part {
    double near = 0, held = 0;
    double pixels = 0;  // over which its points are spread
  };
  std::array<Part, std::size_t{parts} * parts> all;
  for (std::int64_t i = 0; i < pixels; i += stride) {
    const int row = static_cast<int>(i / width), column = static_cast<int>(i % width);
    if (!holds(row, column)) continue;
    const auto in_rows = around(rows, row), in_columns = around(columns, column);
    const std::int64_t window = countAround(rows, row, in_rows) * countAround(columns, column, in_columns);
    std::int64_t held = 0;
    for (int r = in_rows.first; r < in_rows.second; ++r)
      for (int c = in_columns.first; c < in_columns.second; ++c) held += holds(r, c) ? 1 : 0;
    Part& part = all[std::int64_t{row} * parts / height * parts + std::int64_t{column} * parts / width];
    part.near += static_cast<double>(window - 1);
    part.held += static_cast<double>(held - 1);
    part.pixels += static_cast<double>(window) / static_cast<double>(held);
  }
  double pixels_of_all = 0, least = 1;
  for (const Part& part : all) pixels_of_all += part.pixels;
  for (const Part& part : all)
    if (part.pixels >= least_share * pixels_of_all) least = std::min(least, part.near > 0 ? part.held / part.near : 0);
  return pixels_of_all > 0 ? least : 0;
}

}  // namespace tufted
