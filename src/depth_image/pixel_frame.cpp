#include "depth_image/pixel_frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace tufted {
std::optional<PixelFrame> fitFrame(const DepthImage& image, const PixelWindow& window, int p) {
  const int count = window.count();
  const Offsets offsets = window.offsets();
  Eigen::Vector3d sum(0, 0, 0), by_row(0, 0, 0), by_column(0, 0, 0);
  double rows = 0, columns = 0, rows_rows = 0, rows_columns = 0, columns_columns = 0;
  for (int i = 0; i < count; ++i) {
    const double row = window.step(i).row, column = window.step(i).column;
    const Eigen::Vector3d d(offsets.x[i], offsets.y[i], offsets.z[i]);
    sum += d;
    by_row += row * d;
    by_column += column * d;
    rows += row;
    columns += column;
    rows_rows += row * row;
    rows_columns += row * column;
    columns_columns += column * column;
  }
  // Moments about the means, with p as one of the points.
  const double share = 1.0 / (count + 1);
  rows_rows -= rows * rows * share;
  rows_columns -= rows * columns * share;
  columns_columns -= columns * columns * share;
  const double determinant = rows_rows * columns_columns - rows_columns * rows_columns;
  if (!(determinant > 0.01)) return std::nullopt;  // a ratio of whole numbers; 0 but for rounding if all are on a line
  by_row -= rows * share * sum;
  by_column -= columns * share * sum;
  const Eigen::Vector3d along_rows = columns_columns * by_row - rows_columns * by_column;
  const Eigen::Vector3d along_columns = rows_rows * by_column - rows_columns * by_row;
  // Normalised first, because products of tiny vectors may leave the range of a double.
  Eigen::Vector3d normal = along_rows.stableNormalized().cross(along_columns.stableNormalized()).stableNormalized();
  if (!(normal.squaredNorm() > 0.5)) return std::nullopt;
  if (normal.dot(image.points.row(p) - image.grid.origin) > 0) normal = -normal;
  return frameOf(normal, window);
}

PixelFrame frameOf(const Eigen::Vector3d& normal, const PixelWindow& window) {
  const int count = window.count();
  const Offsets offsets = window.offsets();
  double squares = 0;
  for (int i = 0; i < count; ++i) squares += Eigen::Vector3d(offsets.x[i], offsets.y[i], offsets.z[i]).squaredNorm();
  return {normal, std::sqrt(2 * squares / std::max(1, count))};
}

}  // namespace tufted
