#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "base/buffer.h"
#include "base/stage_clock.h"
#include "neighbors/scan/ranked_scan.h"

namespace tufted {

/// Which point is in which pixel of a depth image. Rows and columns without any point are left out, so that an image of
/// which every fourth row and column was kept is as good as a whole one. A margin without points goes around.
struct PixelGrid {
  static constexpr int margin = 3;

  int rows = 0, columns = 0;   ///< with margins
  Buffer<int> rank;            ///< rows x columns, -1: no point
  Buffer<std::int64_t> pixel;  ///< n, -1: no pixel, or one that a point of a smaller rank has
  Eigen::RowVector3d origin;   ///< of the rays, in units of the cloud

  /// Whether a pixel lies within the margins.
  bool isInImage(int row, int column) const {
    return row >= margin && column >= margin && row < rows - margin && column < columns - margin;
  }
  int rowOf(int p) const { return static_cast<int>(pixel[p] / columns); }
  int columnOf(int p) const { return static_cast<int>(pixel[p] % columns); }
  std::size_t bytes() const { return bytesOf(rank) + bytesOf(pixel); }
};

/// @throws InvalidInput for rows and columns that are no image: more than 2^24 pixels and 64 per entry of the structure
PixelGrid pixelGrid(const RankedScan& scan);

}  // namespace tufted
