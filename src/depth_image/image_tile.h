#pragma once

#include <array>
#include <cstdint>

#include "base/point_buffer.h"
#include "depth_image/pixel_grid.h"
#include "depth_image/surface_windows.h"
#include "depth_image/window_pixels.h"
#include "simd/kernels.h"

namespace tufted {

/// Transposes 64 x 64 bits, so that a set of pixels per step becomes a set of steps per pixel.
void transposeBits(std::array<std::uint64_t, 64>& words);

/// A part of a depth image, and the surface around each of its pixels (step 3 in section 28 of docs/algorithm.md).
class ImageTile {
 public:
  static constexpr int halo = WindowPixels::reach;  ///< width of the frame that windows reach into
  /// Pixels of a tile, without the halo: it stays in the second-level cache, its columns are seven packets, and with
  /// the halo a row is a word.
  static constexpr int rows = 32, columns = 56;
  static constexpr int steps_down = WindowPixels::count / 2;  ///< steps to a later pixel; the others are their inverses

  /// Takes the pixels of a part of the image and tests all steps between them.
  /// @param top,left first pixel of the halo
  /// @param tolerance see JumpTest
  /// @returns whether there is a point outside of the halo
  bool take(const PixelGrid& grid, const PointsView& points, int top, int left, const RangeNoise& tolerance);

  /// Finds the windows of the pixels of one row, see SurfaceWindows::around.
  /// @param row from 0
  /// @param[out] windows that of pixel i has the number i + halo
  /// @returns the number of points in these windows that a jump leaves out
  std::int64_t findWindows(int row, std::array<std::uint64_t, pixels_in_word>& windows);

  int rankAt(int row, int column) const { return rank_[at(row, column)]; }
  const double* rangeAt(int row, int column) const { return range_.data() + at(row, column); }
  /// Inverse depths, see PixelGrid::depthOf(); the next row is rowStep() farther.
  const double* inverseAt(int row, int column) const { return inverse_.data() + at(row, column); }
  static constexpr int rowStep() { return pixels_in_word; }
  /// Only for images that go round.
  const InverseSlope& slopeAt(int row, int column) const { return slope_[at(row, column)]; }
  /// Mean squared spacings, in inverse depth, between eight pixels and those of ring 1 in their windows, for the row of
  /// the last findWindows().
  void spacings(int row, int column, double* squared) const;

 private:
  static constexpr int all_rows = rows + 2 * halo;
  static constexpr int all_pixels = all_rows * pixels_in_word;
  /// With room for steps from the last pixels.
  using Values = std::array<double, all_pixels + halo*(pixels_in_word + 1) + kernel_packet>;

  static constexpr int at(int row, int column) { return (row + halo) * pixels_in_word + column + halo; }
  PixelPoints pixelsAt(int pixel) const {
    return {x_.data() + pixel, y_.data() + pixel, z_.data() + pixel, range_.data() + pixel};
  }

  std::uint64_t own_ = 0;  ///< pixels of a row that are in the image and not in the halo
  void findSlopes(const PixelGrid& grid, const PointsView& points, int top, int left);
  /// Also joins pixels across steep steps if the slope continues (2. of *Rings* in section 28).
  void joinAlongSlopes(int row, const JumpTest& test);

  std::array<int, all_pixels> rank_{};
  Values x_{}, y_{}, z_{}, range_{}, inverse_{};
  std::array<InverseSlope, all_pixels> slope_{};  ///< of images that go round
  // Sets of pixels, by row.
  std::array<std::uint64_t, all_rows> is_filled_{};  ///< with a point
  std::array<std::uint64_t, all_rows> is_open_{};    ///< in the image without a point, so that windows may step over it
  /// joined with the pixel that the step down leads to
  std::array<std::array<std::uint64_t, steps_down>, all_rows> joined_{};
  std::array<std::uint64_t, WindowPixels::count> around_{};  ///< windows of one row, by step
};

}  // namespace tufted
