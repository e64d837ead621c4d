#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "base/stage_clock.h"
#include "depth_image/window_pixels.h"
#include "neighbors/scan/ranked_scan.h"

namespace tufted {

/// Which point is in which pixel of a depth image. Rows and columns without any point are left out, so that an image of
/// which every fourth row and column was kept is as good as a whole one. A margin goes around: without points, but to
/// the left and right of an image that goes round it repeats what lies beyond the seam.
struct PixelGrid {
  /// Pixels without points around the image, so that no window leaves it.
  static constexpr int margin = 3;

  int rows = 0, columns = 0;                   ///< with margins
  Buffer<int> rank;                            ///< rows x columns, -1: no point
  Buffer<std::int64_t> pixel;                  ///< n, -1: no pixel, or one that a point of a smaller rank has
  Buffer<std::int64_t> row_line, column_line;  ///< of the caller, by row and column without margins
  Eigen::RowVector3d origin;                   ///< of the rays, in units of the cloud
  /// The axis of a pinhole camera, or the one around which a scanner spins: unit length, zero where the image is of
  /// neither.
  Eigen::RowVector3d axis = Eigen::RowVector3d::Zero();
  bool goes_round = false;  ///< the last column is a neighbour of the first, as around a spinning scanner

  /// The distance of a point from the camera along its axis, or from the axis of a scanner; where there is none the
  /// range. Its inverse is linear on planes over the image of a pinhole camera, and nearly over the other two.
  double depthOf(const Eigen::RowVector3d& point) const {
    const Eigen::RowVector3d sight = point - origin;
    if (axis.isZero(0)) return sight.norm();
    return goes_round ? sight.cross(axis).norm() : sight.dot(axis);
  }
  /// Whether a pixel lies within the margins, or in one that repeats the image.
  bool isInImage(int row, int column) const {
    const int side = goes_round ? 0 : margin;
    return row >= margin && column >= side && row < rows - margin && column < columns - side;
  }
  int columnsInImage() const { return columns - 2 * margin; }
  /// The rank at a pixel any number of columns away from the image, which may go round.
  int rankAt(int row, int column) const { return rank[std::int64_t{row} * columns + wrapped(column)]; }
  /// Whether a column is not in the margins.
  bool isHome(int column) const { return column >= margin && column < columns - margin; }
  int wrapped(int column) const {
    if (!goes_round || isHome(column)) return column;
    const int around = columnsInImage(), past = (column - margin) % around;
    return margin + (past < 0 ? past + around : past);
  }
  /// The short way round.
  PixelStep stepBetween(int p, int q) const {
    const int step = columnOf(q) - columnOf(p), around = columnsInImage();
    const int turn = !goes_round || 2 * std::abs(step) <= around ? 0 : step < 0 ? around : -around;
    return {rowOf(q) - rowOf(p), step + turn};
  }
  int rowOf(int p) const { return static_cast<int>(pixel[p] / columns); }
  int columnOf(int p) const { return static_cast<int>(pixel[p] % columns); }
  std::size_t bytes() const { return bytesOf(rank) + bytesOf(pixel); }
};

/// @throws InvalidInput for rows and columns that are no image: more than 2^24 pixels and 64 per entry of the structure
/// @param around the columns of an image that goes round, none of which is left out, more than 2 x margin; 0: it ends
/// at the sides
PixelGrid pixelGrid(const RankedScan& scan, int around = 0);

/// Of the pixels near points, the share that hold points; see tufted/scan_structure.h.
double pixelFill(const PixelGrid& grid);

/// How far samples of so many pixels, row by row, are apart, so that they lie in all columns.
std::int64_t sampleStride(std::int64_t pixels, std::int64_t samples, std::int64_t row);

/// Sets the axis of a scanner, which is that of z, or of the pinhole camera if there is one. Of a camera's points the
/// few that do not lie well in front of it, as missing ones that are stored as 0, lose their pixels.
void findAxis(const PointsView& points, const Workers& workers, PixelGrid& grid);

}  // namespace tufted
