#pragma once

#include <array>
#include <cstdint>

#include "base/point_buffer.h"
#include "depth_image/pixel_grid.h"
#include "depth_image/surface_windows.h"
#include "depth_image/window_pixels.h"
#include "simd/kernels.h"

namespace tufted {

/// The inverse of a set of pixels for each step: a set of steps for each pixel. Bit i of number j becomes bit j of
/// number i.
void transposeBits(std::array<std::uint64_t, 64>& words);

/// A part of a depth image, and which pixels around each of its own are of one surface with it.
class ImageTile {
 public:
  static constexpr int halo = WindowPixels::reach;  ///< pixels around that windows of the part reach
  /// A tile stays in the second-level cache; its columns are seven packets and, with what windows reach, the bits of a
  /// word.
  static constexpr int rows = 32, columns = 56;
  static constexpr int steps_down = WindowPixels::count / 2;  ///< to a later pixel of the image; the others are inverse

  /// Takes a part of the image with all steps between its pixels.
  /// @param top,left first pixel with the halo
  /// @param tolerance see JumpTest
  /// @returns whether the part itself holds a point
  bool take(const PixelGrid& grid, const PointsView& points, int top, int left, const RangeNoise& tolerance);

  /// The windows of the pixels of one row, as SurfaceWindows has them: sets of steps.
  /// @param row from 0; pixel i of the row has number i + halo
  /// @returns how many points in these windows are left out
  std::int64_t findWindows(int row, std::array<std::uint64_t, pixels_in_word>& windows);

  int rankAt(int row, int column) const { return rank_[at(row, column)]; }
  const double* rangeAt(int row, int column) const { return range_.data() + at(row, column); }
  /// Inverse depths, see PixelGrid::depthOf(); what lies rowStep() on is one row below.
  const double* inverseAt(int row, int column) const { return inverse_.data() + at(row, column); }
  static constexpr int rowStep() { return pixels_in_word; }
  /// For images that go round.
  const InverseSlope& slopeAt(int row, int column) const { return slope_[at(row, column)]; }
  /// Squared spacings in inverse depth between eight pixels and those beside them, for the row of the last
  /// findWindows().
  void spacings(int row, int column, double* squared) const;

 private:
  static constexpr int all_rows = rows + 2 * halo;
  static constexpr int all_pixels = all_rows * pixels_in_word;
  /// Steps from the last pixels read beyond them.
  using Values = std::array<double, all_pixels + halo*(pixels_in_word + 1) + kernel_packet>;

  static constexpr int at(int row, int column) { return (row + halo) * pixels_in_word + column + halo; }
  PixelPoints pixelsAt(int pixel) const {
    return {x_.data() + pixel, y_.data() + pixel, z_.data() + pixel, range_.data() + pixel};
  }

  std::uint64_t own_ = 0;  ///< the pixels of a row that are of the image and not of the halo
  void findSlopes(const PixelGrid& grid, const PointsView& points, int top, int left);
  /// Joins pixels of a row with others as well where the step between them is steep and the slope goes on.
  void joinAlongSlopes(int row, const JumpTest& test);

  std::array<int, all_pixels> rank_{};
  Values x_{}, y_{}, z_{}, range_{}, inverse_{};
  std::array<InverseSlope, all_pixels> slope_{};  ///< of an image that goes round
  // Sets of the pixels of each row.
  std::array<std::uint64_t, all_rows> is_filled_{};  ///< with a point
  std::array<std::uint64_t, all_rows> is_open_{};    ///< without, but in the image, so that it can be stepped over
  std::array<std::array<std::uint64_t, steps_down>, all_rows> joined_{};  ///< by steps down from each pixel
  std::array<std::uint64_t, WindowPixels::count> around_{};               ///< of one row, by step
};

}  // namespace tufted
