#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "base/stage_clock.h"
#include "depth_image/window_pixels.h"
#include "neighbors/scan/ranked_scan.h"

namespace tufted {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();  ///< depth of a pixel without a point

/// The point in each pixel of a depth image (step 1 in section 28 of docs/algorithm.md). Rows and columns without any
/// point are left out, so that an image of which every fourth row and column was kept is as good as a whole one. Around
/// it is a margin without points; in an image that goes round, the margins left and right repeat what lies beyond the
/// seam.
struct PixelGrid {
  /// Width of the margin, so that no window leaves the grid.
  static constexpr int margin = 3;

  int rows = 0, columns = 0;                   ///< with margins
  Buffer<int> rank;                            ///< rows x columns; -1: no point
  Buffer<std::int64_t> pixel;                  ///< n; -1: no pixel, or one taken by a point of smaller rank
  Buffer<std::int64_t> row_line, column_line;  ///< the caller's numbers of rows and columns, without margins
  Eigen::RowVector3d origin;                   ///< the sensor, in units of the cloud
  /// Unit axis of a pinhole camera, or around which a scanner spins; zero if the image is of neither.
  Eigen::RowVector3d axis = Eigen::RowVector3d::Zero();
  bool goes_round = false;  ///< whether the last column is beside the first, as for a spinning scanner

  /// The depth of a point: its distance along the axis of a camera, or from that of a scanner; without an axis its
  /// range. Its inverse is linear on planes over the image of a pinhole camera, and nearly so over others.
  double depthOf(const Eigen::RowVector3d& point) const {
    const Eigen::RowVector3d sight = point - origin;
    if (axis.isZero(0)) return sight.norm();
    return goes_round ? sight.cross(axis).norm() : sight.dot(axis);
  }
  /// Whether a pixel is in the image or in a margin that repeats it.
  bool isInImage(int row, int column) const {
    const int side = goes_round ? 0 : margin;
    return row >= margin && column >= side && row < rows - margin && column < columns - side;
  }
  int columnsInImage() const { return columns - 2 * margin; }
  /// The rank at a pixel; in an image that goes round the column may be any number.
  int rankAt(int row, int column) const { return rank[std::int64_t{row} * columns + wrapped(column)]; }
  /// Whether a column is outside of the margins.
  bool isHome(int column) const { return column >= margin && column < columns - margin; }
  int wrapped(int column) const {
    if (!goes_round || isHome(column)) return column;
    const int around = columnsInImage(), past = (column - margin) % around;
    return margin + (past < 0 ? past + around : past);
  }
  /// The step from p to q, the short way round.
  PixelStep stepBetween(int p, int q) const {
    const int step = columnOf(q) - columnOf(p), around = columnsInImage();
    const int turn = !goes_round || 2 * std::abs(step) <= around ? 0 : step < 0 ? around : -around;
    return {rowOf(q) - rowOf(p), step + turn};
  }
  int rowOf(int p) const { return static_cast<int>(pixel[p] / columns); }
  int columnOf(int p) const { return static_cast<int>(pixel[p] % columns); }
  std::size_t bytes() const { return bytesOf(rank) + bytesOf(pixel); }
};

/// Places the points of a scan in pixels.
/// @throws InvalidInput for rows and columns that are no image: more than 2^24 pixels and more than 64 per entry
/// @param around columns of an image that goes round, more than 2 x margin, of which none is left out; 0: it does not
PixelGrid pixelGrid(const RankedScan& scan, int around = 0);

/// The share of the surface that is sparse, see sparseShare() in tufted/scan_structure.h.
double sparseShare(const PixelGrid& grid);

/// The stride of about `samples` of so many pixels, prime to the length of a row, so that samples lie in all columns.
std::int64_t sampleStride(std::int64_t pixels, std::int64_t samples, std::int64_t row);

/// Sets the axis: z for a scanner, or that of the pinhole camera if one fits. The few points that are not well in front
/// of a camera, such as missing ones stored as 0, lose their pixels.
void findAxis(const PointsView& points, const Workers& workers, PixelGrid& grid);

}  // namespace tufted
