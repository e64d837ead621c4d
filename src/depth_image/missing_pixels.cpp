#include "depth_image/missing_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "depth_image/window_pixels.h"

namespace tufted {
namespace {

constexpr std::array<PixelStep, 4> directions = {{{0, 1}, {1, 0}, {1, 1}, {1, -1}}};

/// The mean over all directions in which the values on both sides may be of one surface; 0 if there is none.
double meanAround(const PixelGrid& grid, const SmoothedRanges& smoothed, const RangeNoise& noise, int row, int column) {
  const std::int64_t pixel = std::int64_t{row} * grid.columns + column;
  const std::ptrdiff_t at = smoothed.at(row, column);
  double sum = 0;
  int count = 0;
  for (const PixelStep& step : directions) {
    const std::int64_t pixels = std::int64_t{step.row} * grid.columns + step.column;
    // Only pixels with points are read, because other threads write the others.
    if (grid.rank[pixel - pixels] < 0 || grid.rank[pixel + pixels] < 0) continue;
    const std::ptrdiff_t values = step.row * smoothed.row_step + step.column;
    const std::ptrdiff_t before = at - values, after = at + values;
    const double most = 2 * std::min(smoothed.steepestSlope(before), smoothed.steepestSlope(after));
    const double change = std::abs(smoothed.inverse[before] - smoothed.inverse[after]);
    const double mean = (smoothed.inverse[before] + smoothed.inverse[after]) / 2;
    if (!(change <= most + SmoothedRanges::tolerance * noise.atInverse(mean))) continue;
    sum += mean;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace

void fillMissingPixels(const PixelGrid& grid, const RangeNoise& noise, const Workers& workers,
                       SmoothedRanges& smoothed) {
  if (grid.goes_round) return;
  const int first = PixelGrid::margin, rows = grid.rows - 2 * first;
  workers.forBlocks("windows", rows, usual_block / grid.columns + 1, [&](std::int64_t begin, std::int64_t end, int) {
    for (int row = first + static_cast<int>(begin); row < first + static_cast<int>(end); ++row) {
      for (int column = first; column < grid.columns - first; ++column) {
        if (grid.rank[std::int64_t{row} * grid.columns + column] >= 0) continue;
        const double mean = meanAround(grid, smoothed, noise, row, column);
        if (mean > 0) smoothed.inverse[smoothed.at(row, column)] = mean;
      }
    }
  });
}

}  // namespace tufted
