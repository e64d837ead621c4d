#include "depth_image/surface_windows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "depth_image/smoothed_ranges.h"
#include "depth_image/window_pixels.h"
#include "simd/kernels.h"

namespace tufted {
namespace {

constexpr int tile_rows = 32, tile_columns = 64;
constexpr int halo = WindowPixels::reach;
constexpr int all_rows = tile_rows + 2 * halo;
constexpr int all_columns = tile_columns + 2 * halo;
constexpr int all_pixels = all_rows * all_columns;

constexpr int steps_down =
    WindowPixels::count / 2;  // steps to a later pixel of the image; the others are their inverse

/// How a step is reached: whether by a step down or by its inverse, and over which pixels one ring further in.
struct Way {
  int shift = 0;  ///< of the pixel's number in a tile
  int down = 0;   ///< number of the step down
  int from = 0;   ///< shift of the pixel that the step down starts at
  int parents = 0;
  std::array<int, 3> parent{};                  ///< numbers of steps
  std::array<int, 3> link_down{}, link_from{};  ///< of the step from each parent on
};

struct Ways {
  std::array<Way, WindowPixels::count> way{};
  std::array<PixelStep, steps_down> down{};
  std::array<int, steps_down> down_shift{};

  constexpr Ways() {
    int size = 0;
    for (const PixelStep& step : window_pixels.step)
      if (isDown(step)) down[size++] = step;
    for (int i = 0; i < steps_down; ++i) down_shift[i] = shiftOf(down[i]);
    for (int i = 0; i < WindowPixels::count; ++i) {
      const PixelStep& step = window_pixels.step[i];
      Way& to = way[i];
      to.shift = shiftOf(step);
      setDown(step, 0, to.down, to.from);
      if (step.ring() == 1) continue;
      for (int j = 0; j < i; ++j) {
        const PixelStep& before = window_pixels.step[j];
        const PixelStep last{step.row - before.row, step.column - before.column};
        if (before.ring() != step.ring() - 1 || last.ring() != 1) continue;
        to.parent[to.parents] = j;
        setDown(last, shiftOf(before), to.link_down[to.parents], to.link_from[to.parents]);
        ++to.parents;
      }
    }
  }

 private:
  static constexpr bool isDown(const PixelStep& step) { return step.row > 0 || (step.row == 0 && step.column > 0); }
  static constexpr int shiftOf(const PixelStep& step) { return step.row * all_columns + step.column; }
  constexpr void setDown(const PixelStep& step, int start, int& number, int& from) const {
    const PixelStep wanted = isDown(step) ? step : PixelStep{-step.row, -step.column};
    number = 0;
    while (down[number].row != wanted.row || down[number].column != wanted.column) ++number;
    from = isDown(step) ? start : start + shiftOf(step);
  }
};

constexpr Ways ways;

/// A part of the image with what windows of its pixels reach.
struct Tile {
  std::array<int, all_pixels> rank;
  std::array<double, all_pixels> x, y, z, range, inverse;
  std::array<std::uint8_t, all_pixels> is_filled;  ///< with a point
  std::array<std::uint8_t, all_pixels> is_open;    ///< without, but in the image, so that it can be stepped over
  std::array<std::array<std::uint8_t, all_pixels>, steps_down> joined;  ///< by steps down from each pixel
  std::array<std::array<std::uint8_t, tile_columns>, WindowPixels::count> reached;
};

class WindowFinder {
 public:
  /// @param smoothed null: nothing moves
  WindowFinder(const PixelGrid& grid, const PointsView& points, double noise, SurfaceWindows& windows,
               SmoothedRanges* smoothed)
      : grid_(grid), points_(points), noise_(noise), test_(noise), windows_(windows), smoothed_(smoothed) {}

  static int inTiles(int pixels, int tile) { return (pixels - 2 * PixelGrid::margin + tile - 1) / tile; }
  int tiles() const { return inTiles(grid_.rows, tile_rows) * inTiles(grid_.columns, tile_columns); }

  void find(int number, Tile& tile, std::int64_t& cut) const {
    const int in_row = inTiles(grid_.columns, tile_columns);
    if (!load(number / in_row * tile_rows, number % in_row * tile_columns, tile)) return;
    join(tile);
    for (int row = 0; row < tile_rows; ++row) findRow((row + halo) * all_columns + halo, tile, cut);
  }

 private:
  /// @param top,left first pixel of the tile with its halo. Returns whether the tile itself holds a point.
  bool load(int top, int left, Tile& tile) const {
    bool any = false;
    for (int row = 0; row < all_rows; ++row) {
      for (int column = 0; column < all_columns; ++column) {
        const int i = row * all_columns + column;
        const bool is_inside = top + row < grid_.rows && left + column < grid_.columns;
        const int p = is_inside ? grid_.rank[std::int64_t{top + row} * grid_.columns + left + column] : -1;
        tile.rank[i] = p;
        tile.is_filled[i] = p < 0 ? 0 : 1;
        tile.is_open[i] = p < 0 && grid_.isInImage(top + row, left + column) ? 1 : 0;
        if (p < 0) {
          tile.x[i] = tile.y[i] = tile.z[i] = tile.range[i] = tile.inverse[i] = 0;
          continue;
        }
        const double* const point = points_.data() + 3 * std::ptrdiff_t{p};
        const double x = tile.x[i] = point[0] - grid_.origin[0];
        const double y = tile.y[i] = point[1] - grid_.origin[1];
        const double z = tile.z[i] = point[2] - grid_.origin[2];
        tile.range[i] = std::sqrt(x * x + y * y + z * z);
        tile.inverse[i] = 1 / tile.range[i];
        any = any || (row >= halo && row < halo + tile_rows && column >= halo && column < halo + tile_columns);
      }
    }
    return any;
  }

  /// Tests every step between two pixels of the tile.
  void join(Tile& tile) const {
    for (int s = 0; s < steps_down; ++s) {
      const double most = JumpTest::steepestOf(ways.down[s]);
      const int shift = ways.down_shift[s], end = all_pixels - shift;
      std::uint8_t* const joined = tile.joined[s].data();
      for (int a = 0; a < end; ++a) {
        const int b = a + shift;
        const double x = tile.x[b] - tile.x[a], y = tile.y[b] - tile.y[a], z = tile.z[b] - tile.z[a];
        joined[a] = test_.joins(x * x + y * y + z * z, tile.range[a], tile.range[b], most) ? 1 : 0;
      }
    }
  }

  void findRow(int first, Tile& tile, std::int64_t& cut) const {
    for (int i = 0; i < WindowPixels::count; ++i) reach(i, first, tile);
    std::array<std::uint64_t, tile_columns> all_around{};
    for (int column = 0; column < tile_columns; ++column) {
      const int pixel = first + column, p = tile.rank[pixel];
      if (p < 0) continue;
      std::uint64_t around = 0, filled = 0;
      for (int i = 0; i < WindowPixels::count; ++i) {
        const std::uint64_t is_filled = tile.is_filled[pixel + ways.way[i].shift];
        around |= (tile.reached[i][column] & is_filled) << i;
        filled |= is_filled << i;
      }
      windows_.around[p] = all_around[column] = around;
      windows_.range[p] = tile.range[pixel];
      cut += std::popcount(filled & ~around);
    }
    if (smoothed_ == nullptr) return;
    for (int column = 0; column < tile_columns; column += kernel_packet)
      smoothSome(first + column, all_around.data() + column, tile);
  }

  /// Which pixels of a row the step leads to, from p or over a pixel reached before.
  static void reach(int i, int first, Tile& tile) {
    const Way& way = ways.way[i];
    const std::uint8_t* const is_open = tile.is_open.data() + first + way.shift;
    const std::uint8_t* const is_filled = tile.is_filled.data() + first + way.shift;
    const std::uint8_t* const joined = tile.joined[way.down].data() + first + way.from;
    std::uint8_t* const reached = tile.reached[i].data();
    for (int column = 0; column < tile_columns; ++column)
      reached[column] = is_open[column] | (is_filled[column] & joined[column]);
    if (way.parents == 0) return;
    std::array<std::uint8_t, tile_columns> linked{}, over{}, refused{};
    for (int j = 0; j < way.parents; ++j) {
      const int parent = way.parent[j];
      const std::uint8_t* const parent_reached = tile.reached[parent].data();
      const std::uint8_t* const parent_filled = tile.is_filled.data() + first + ways.way[parent].shift;
      const std::uint8_t* const link = tile.joined[way.link_down[j]].data() + first + way.link_from[j];
      for (int column = 0; column < tile_columns; ++column) {
        const std::uint8_t is_linked = is_open[column] | link[column];
        over[column] |= parent_reached[column] & (parent_filled[column] ^ 1);
        linked[column] |= parent_reached[column] & parent_filled[column] & is_linked;
        refused[column] |= parent_reached[column] & parent_filled[column] & (is_linked ^ 1);
      }
    }
    for (int column = 0; column < tile_columns; ++column)
      reached[column] &= linked[column] | (over[column] & (refused[column] ^ 1));
  }

  /// Smooths a packet of pixels.
  void smoothSome(int first, const std::uint64_t* around, const Tile& tile) const {
    bool any_narrow = false, any_wide = false;
    std::array<bool, kernel_packet> is_wanted{};
    for (int lane = 0; lane < kernel_packet; ++lane) {
      const int pixel = first + lane, p = tile.rank[pixel];
      if (p < 0) continue;
      const std::uint64_t beside = around[lane] & WindowPixels::rings(1);
      const double spacing_squared = beside == 0 ? 0 : spacingSquared(pixel, beside, tile);
      smoothed_->range[p] = {tile.inverse[pixel], 0};
      smoothed_->spacing_squared[p] = spacing_squared;
      is_wanted[lane] = beside != 0 && needsSmoothing(tile.inverse[pixel], noise_, spacing_squared);
      any_narrow |= is_wanted[lane] && (around[lane] & WindowPixels::rings(2)) == WindowPixels::rings(2);
      any_wide |= is_wanted[lane] && around[lane] == WindowPixels::rings(3);
    }
    const PixelRows rows{tile.inverse.data() + first, all_columns, 1};
    SquareFits narrow{}, wide{};
    if (any_narrow) kernels().fitSquares5(rows, narrow);
    if (any_wide) kernels().fitSquares7(rows, wide);
    for (int lane = 0; lane < kernel_packet; ++lane) {
      if (!is_wanted[lane]) continue;
      const auto smoothed = smoothedInverseRange({rows.at + lane, rows.row_step, rows.column_step}, around[lane],
                                                 {narrow.value[lane], narrow.variance[lane]},
                                                 {wide.value[lane], wide.variance[lane]}, noise_);
      if (smoothed) smoothed_->range[tile.rank[first + lane]] = *smoothed;
    }
  }

  /// The squared spacing, in inverse range, between a pixel and those beside it that are joined with it.
  static double spacingSquared(int pixel, std::uint64_t beside, const Tile& tile) {
    double across = 0;
    forEachPixel(beside, [&](int i) {
      const int q = pixel + ways.way[i].shift;
      const double x = tile.x[q] - tile.x[pixel], y = tile.y[q] - tile.y[pixel], z = tile.z[q] - tile.z[pixel];
      const double along = tile.range[q] - tile.range[pixel];
      across += x * x + y * y + z * z - along * along;
    });
    const double square = tile.inverse[pixel] * tile.inverse[pixel];
    return across / std::popcount(beside) * square * square;
  }

  const PixelGrid& grid_;
  PointsView points_;
  double noise_;
  JumpTest test_;
  SurfaceWindows& windows_;
  SmoothedRanges* smoothed_;
};

}  // namespace

SurfaceWindows findSurfaceWindows(const PixelGrid& grid, const PointsView& points, double noise, bool smooths,
                                  const Workers& workers) {
  SurfaceWindows windows;
  const auto n = static_cast<std::size_t>(points.rows());
  windows.around.assign(n, 0);
  windows.range.resize(n);
  SmoothedRanges smoothed;
  if (smooths) smoothed.resize(n);
  const WindowFinder finder(grid, points, noise, windows, smooths ? &smoothed : nullptr);
  Buffer<Tile> tiles(workers.count());
  Buffer<std::int64_t> cut(workers.count());
  workers.forBlocks("windows", finder.tiles(), 1, [&](std::int64_t begin, std::int64_t end, int worker) {
    for (std::int64_t number = begin; number < end; ++number)
      finder.find(static_cast<int>(number), tiles[worker], cut[worker]);
  });
  windows.cut = std::accumulate(cut.begin(), cut.end(), std::int64_t{0});
  if (!smooths) return windows;
  smoothFurther(grid, smoothed, noise, workers);
  windows.displacement = displacementsAlongRays(grid, points, smoothed, workers, windows.moved);
  windows.place.resize(points.rows());
  windows.place.all() = points + windows.displacement.all();
  return windows;
}

}  // namespace tufted
