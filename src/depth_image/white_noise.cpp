#include "depth_image/white_noise.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace tufted {
namespace {

constexpr std::int64_t samples = 8000;
/// Of neighbours on one side: .47 for white noise about a quadratic over 7 x 7 pixels, .5 about the surface.
constexpr double least_on_one_side = 0.45, most_on_one_side = 0.53;

}  // namespace

bool changesSidesFreely(const PixelGrid& grid, const PointsView& points, const SmoothedRanges& smoothed) {
  // 1 behind the surface, -1 in front of it, 0 where nothing was smoothed.
  const auto sideOf = [&](std::int64_t pixel) {
    const int p = grid.rank[pixel];
    if (p < 0) return 0;
    const auto row = static_cast<int>(pixel / grid.columns), column = static_cast<int>(pixel % grid.columns);
    const std::ptrdiff_t at = smoothed.at(row, column);
    if (smoothed.variance[at] == 0) return 0;
    return 1 / grid.depthOf(points.row(p)) < smoothed.inverse[at] ? 1 : -1;
  };
  std::array<std::int64_t, 2> pairs{}, on_one_side{};  // along rows, along columns
  const std::int64_t end = std::ssize(grid.rank) - grid.columns;
  const std::int64_t stride = std::max<std::int64_t>(1, end / samples) | 1;
  for (std::int64_t pixel = 0; pixel < end; pixel += stride) {
    const int side = sideOf(pixel);
    if (side == 0) continue;
    for (const int direction : {0, 1}) {
      const int next = sideOf(pixel + (direction == 0 ? 1 : grid.columns));
      pairs[direction] += next != 0 ? 1 : 0;
      on_one_side[direction] += next == side ? 1 : 0;
    }
  }
  return std::ranges::all_of(std::array{0, 1}, [&](int direction) {
    const auto all = static_cast<double>(pairs[direction]), same = static_cast<double>(on_one_side[direction]);
    return all > 0 && same >= least_on_one_side * all && same <= most_on_one_side * all;
  });
}

}  // namespace tufted
