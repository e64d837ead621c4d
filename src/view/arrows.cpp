#include "view/arrows.h"

#include <algorithm>
#include <cmath>

#include "view/shading.h"

namespace tufted::view {

namespace {

/// Cells, each with at most one arrow, in the height of a picture; with more of them arrows would touch.
constexpr int cells = 34;
/// The arrow of a vector as long as the legend's greatest value, in cells: it does not reach the next cell.
constexpr double longest = 0.95;
/// Arrows shorter than this, in cells, are not drawn, as their direction would not be visible.
constexpr double shortest = 0.12;

/// The visible point nearest to the middle of a cell; -1: none.
int pointIn(const SeenScene& seen, const FieldColors& colors, int left, int top, int size) {
  int best = -1;
  int least = size * size;
  for (int y = top; y < std::min(top + size, seen.height); ++y)
    for (int x = left; x < std::min(left + size, seen.width); ++x) {
      const Sample sample = seen.samples[static_cast<std::size_t>(y) * seen.width + x];
      if (sample == nothing) continue;
      std::uint32_t number = numberOf(sample);
      const auto n = static_cast<std::uint32_t>(seen.scene.positions.rows());
      if (number >= n) number = static_cast<std::uint32_t>(seen.scene.triangles(number - n, 0));
      const int dx = x - left - size / 2;
      const int dy = y - top - size / 2;
      if (dx * dx + dy * dy >= least || !std::isfinite(colors.channels[0][number])) continue;
      least = dx * dx + dy * dy;
      best = static_cast<int>(number);
    }
  return best;
}

}  // namespace

void drawArrows(const SeenScene& seen, const FieldColors& colors, Canvas& canvas) {
  const int size = std::max(seen.height / cells, 8);
  const double cell = static_cast<double>(size) / samples_per_pixel;
  for (int top = 0; top < seen.height; top += size)
    for (int left = 0; left < seen.width; left += size) {
      const int point = pointIn(seen, colors, left, top, size);
      if (point < 0 || !(colors.high > 0)) continue;
      const Eigen::Vector3d vector = colors.field->values.row(point);
      const Eigen::Vector3d seen_vector = seen.projection.turn(vector) / colors.high;
      const Eigen::Vector2d along = longest * cell * Eigen::Vector2d(seen_vector.x(), -seen_vector.y());
      const double length = std::min(along.norm(), 2 * cell);
      if (length < shortest * cell) continue;
      const Eigen::Vector3d view = seen.views[static_cast<std::size_t>(point)].cast<double>();
      const Eigen::Vector2d middle(seen.projection.screenX(view) / samples_per_pixel,
                                   seen.projection.screenY(view) / samples_per_pixel);
      const Eigen::Vector2d unit = along.normalized();
      const Eigen::Vector2d aside(-unit.y(), unit.x());
      const Eigen::Vector2d start = middle - 0.5 * length * unit;
      const Eigen::Vector2d tip = middle + 0.5 * length * unit;
      const double head = std::min(0.4 * cell, 0.55 * length);
      const Eigen::Vector2d neck = tip - head * unit;
      const Rgb color = colors.colorOf({colors.channels[0][static_cast<std::size_t>(point)], 0});
      canvas.line(start.x(), start.y(), neck.x(), neck.y(), std::max(1.2, 0.09 * cell), color);
      canvas.triangle({tip, neck + 0.42 * head * aside, neck - 0.42 * head * aside}, color);
    }
}

}  // namespace tufted::view
