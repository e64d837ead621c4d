#include "depth_image/pixel_frame.h"

#include <Eigen/Geometry>
#include <cmath>

#include "stars/tangent_frame.h"

namespace tufted {
namespace {

constexpr double flat_share = 0.02;  // of the second variance, as in stars.cpp

}  // namespace

bool isFlat(double height_variance, double second) {
  return height_variance < flat_share * second;
}

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
  // About the means; p is one of the points.
  const double share = 1.0 / (count + 1);
  rows_rows -= rows * rows * share;
  rows_columns -= rows * columns * share;
  columns_columns -= columns * columns * share;
  const double determinant = rows_rows * columns_columns - rows_columns * rows_columns;
  if (!(determinant > 0.01)) return std::nullopt;  // a fraction of whole numbers, and 0 but for rounding on a line
  by_row -= rows * share * sum;
  by_column -= columns * share * sum;
  const Eigen::Vector3d along_rows = columns_columns * by_row - rows_columns * by_column;
  const Eigen::Vector3d along_columns = rows_rows * by_column - rows_columns * by_row;
  // Scaled first: products of tiny steps may leave the range of a double.
  Eigen::Vector3d normal = along_rows.stableNormalized().cross(along_columns.stableNormalized()).stableNormalized();
  if (!(normal.squaredNorm() > 0.5)) return std::nullopt;
  if (normal.dot(image.points.row(p) - image.grid.origin) > 0) normal = -normal;
  return frameOf(normal, window);
}

PixelFrame frameOf(const Eigen::Vector3d& normal, const PixelWindow& window) {
  const int count = window.count();
  const Offsets offsets = window.offsets();
  const Eigen::Vector3d x = tangentOf(normal), y = normal.cross(x);
  double squares = 0, heights = 0, height_sum = 0, uu = 0, uv = 0, vv = 0;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d d(offsets.x[i], offsets.y[i], offsets.z[i]);
    const double h = d.dot(normal), u = d.dot(x), v = d.dot(y);
    squares += h * h + u * u + v * v;
    heights += h * h;
    height_sum += h;
    uu += u * u;
    uv += u * v;
    vv += v * v;
  }
  const double n = count + 1;
  const double variance = heights / n - (height_sum / n) * (height_sum / n);
  const double middle = (uu + vv) / 2, second = (middle - std::hypot((uu - vv) / 2, uv)) / n;
  return {normal, std::sqrt(2 * squares / std::max(1, count)), isFlat(variance, second)};
}

}  // namespace tufted
