#include "depth_image/surface_windows.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "depth_image/image_tile.h"
#include "depth_image/missing_pixels.h"
#include "depth_image/smoothed_ranges.h"
#include "depth_image/white_noise.h"

namespace tufted {
namespace {

class WindowFinder {
 public:
  /// @param smoothed null: nothing is smoothed
  WindowFinder(const PixelGrid& grid, const PointsView& points, const RangeNoise& noise, SurfaceWindows& windows,
               SmoothedRanges* smoothed)
      : grid_(grid),
        points_(points),
        noise_(noise),
        test_(JumpTest::of(noise)),
        windows_(windows),
        smoothed_(smoothed) {}

  static int inTiles(int pixels, int tile) { return (pixels - 2 * PixelGrid::margin + tile - 1) / tile; }
  int tiles() const { return inTiles(grid_.rows, ImageTile::rows) * inTiles(grid_.columns, ImageTile::columns); }

  void find(int number, ImageTile& tile, std::int64_t& cut) const {
    const int in_row = inTiles(grid_.columns, ImageTile::columns);
    const int top = number / in_row * ImageTile::rows, left = number % in_row * ImageTile::columns;
    if (!tile.take(grid_, points_, top, left, test_.tolerance)) return;
    std::array<std::uint64_t, pixels_in_word> windows;
    const int columns = std::min(ImageTile::columns, grid_.columnsInImage() - left);
    for (int row = 0; row < ImageTile::rows; ++row) {
      cut += tile.findWindows(row, windows);
      for (int column = 0; column < columns; ++column) {
        const int p = tile.rankAt(row, column);
        if (p < 0) continue;
        windows_.around[p] = windows[column + ImageTile::halo];
        windows_.range[p] = *tile.rangeAt(row, column);
        if (grid_.goes_round) windows_.slope[p] = tile.slopeAt(row, column);
      }
      if (smoothed_ == nullptr) continue;
      const std::ptrdiff_t first = smoothed_->at(top + ImageTile::halo + row, left + ImageTile::halo);
      for (int column = 0; column < columns; column += kernel_packet)
        smoothSome(tile, row, column, windows.data() + column + ImageTile::halo, first + column);
    }
  }

 private:
  /// Smooths a packet of pixels.
  /// @param at index of the first one in SmoothedRanges
  void smoothSome(const ImageTile& tile, int row, int column, const std::uint64_t* around, std::ptrdiff_t at) const {
    std::array<double, kernel_packet> spacing_squared, noise;
    tile.spacings(row, column, spacing_squared.data());
    const PixelRows rows{tile.inverseAt(row, column), ImageTile::rowStep(), 1};
    unsigned is_filled = 0, is_wanted = 0, is_narrow = 0, is_wide = 0;
    for (int lane = 0; lane < kernel_packet; ++lane) {
      if (tile.rankAt(row, column + lane) < 0) continue;
      const unsigned here = 1U << lane;
      is_filled |= here;
      noise[lane] = noise_.atInverse(rows.at[lane]);
      if ((around[lane] & WindowPixels::rings(1)) == 0 ||
          !needsSmoothing(rows.at[lane], noise[lane], spacing_squared[lane]))
        continue;
      is_wanted |= here;
      if ((around[lane] & WindowPixels::rings(2)) == WindowPixels::rings(2)) is_narrow |= here;
      if (around[lane] == WindowPixels::rings(3)) is_wide |= here;
    }
    SquareFits narrow{}, wide{};
    if (is_narrow != 0) kernels().fitSquares5(rows, narrow);
    if (is_wide != 0) kernels().fitSquares7(rows, wide);
    for (int lane = 0; lane < kernel_packet; ++lane) {
      if ((is_filled >> lane & 1U) == 0) continue;
      SmoothedRange range{rows.at[lane], 0};
      if ((is_wanted >> lane & 1U) != 0) {
        range = smoothedInverseDepth({rows.at + lane, rows.row_step, rows.column_step}, around[lane],
                                     {narrow.value[lane], narrow.variance[lane]},
                                     {wide.value[lane], wide.variance[lane]}, noise[lane], spacing_squared[lane])
                    .value_or(range);
      }
      smoothed_->inverse[at + lane] = range.inverse;
      smoothed_->variance[at + lane] = range.variance;
      smoothed_->spacing_squared[at + lane] = spacing_squared[lane];
    }
  }

  const PixelGrid& grid_;
  PointsView points_;
  RangeNoise noise_;
  JumpTest test_;
  SurfaceWindows& windows_;
  SmoothedRanges* smoothed_;
};

}  // namespace

SurfaceWindows findSurfaceWindows(const PixelGrid& grid, const PointsView& points, const RangeNoise& noise,
                                  bool smooths, const Workers& workers) {
  SurfaceWindows windows;
  const auto n = static_cast<std::size_t>(points.rows());
  windows.around.assign(n, 0);
  windows.range.resize(n);
  if (grid.goes_round) windows.slope.resize(n);
  SmoothedRanges smoothed;
  if (smooths) smoothed.clear(grid, workers);
  const WindowFinder finder(grid, points, noise, windows, smooths ? &smoothed : nullptr);
  Buffer<ImageTile> tiles(workers.count());
  Buffer<std::int64_t> cut(workers.count());
  workers.forBlocks("windows", finder.tiles(), 1, [&](std::int64_t begin, std::int64_t end, int worker) {
    for (std::int64_t number = begin; number < end; ++number)
      finder.find(static_cast<int>(number), tiles[worker], cut[worker]);
  });
  windows.cut = std::accumulate(cut.begin(), cut.end(), std::int64_t{0});
  if (!smooths) return windows;
  fillMissingPixels(grid, noise, workers, smoothed);
  smoothFurther(noise, changesSidesFreely(grid, points, smoothed, noise, workers), workers, smoothed);
  moveAlongRays(grid, points, smoothed, workers, windows);
  return windows;
}

}  // namespace tufted
