#pragma once

#include <array>
#include <cstdint>

#include "depth_image/window_pixels.h"

namespace tufted {

/// From one pixel to the next of its row, or the next of its column.
enum Direction : int { right, down };

/// The pixels of a window before and after its middle one. With the middle row or column left out, through which a line
/// may run that lies aslant.
struct WindowHalves {
  std::array<std::uint64_t, 2> before{}, after{};  ///< by Direction

  constexpr WindowHalves() {
    for (int i = 0; i < WindowPixels::count; ++i) {
      const PixelStep& step = window_pixels.step[i];
      const std::uint64_t pixel = std::uint64_t{1} << i;
      before[right] |= step.column < 0 ? pixel : 0;
      after[right] |= step.column > 0 ? pixel : 0;
      before[down] |= step.row < 0 ? pixel : 0;
      after[down] |= step.row > 0 ? pixel : 0;
    }
  }
};

inline constexpr WindowHalves window_halves;

}  // namespace tufted
