#include "depth_image/pixel_window.h"

#include <cmath>
#include <limits>

namespace tufted {

void PixelWindow::take(const DepthImage& image, int p, int rings) {
  neighbors_.clear();
  steps_.clear();
  const std::int64_t pixel = image.grid.pixel[p];
  const std::uint64_t around = image.windows.around[p] & WindowPixels::rings(rings);
  forEachPixel(around, [&](int i) {
    const PixelStep& step = window_pixels.step[i];
    neighbors_.push_back({0, image.grid.rank[pixel + std::int64_t{step.row} * image.grid.columns + step.column]});
    steps_.push_back(step);
  });
  rings_ = rings;
  last_ring_ = std::popcount(around & WindowPixels::rings(rings - 1));
  measure(image, p);
}

void PixelWindow::widen(const DepthImage& image, int p, int rings) {
  const PixelGrid& grid = image.grid;
  const int row = grid.rowOf(p), column = grid.columnOf(p);
  const int side = 2 * rings + 1;
  const auto isInImage = [&](int r, int c) { return grid.isInImage(r, grid.wrapped(c)); };
  reached_.assign(static_cast<std::size_t>(side) * side, 0);
  const auto reached = [&](int i, int j) -> std::uint8_t& { return reached_[(i + rings) * side + j + rings]; };
  reached(0, 0) = 1;
  neighbors_.clear();
  steps_.clear();
  rings_ = rings;
  const auto visit = [&](int ring, int i, int j) {
    const int r = row + i, c = column + j;
    if (!isInImage(r, c)) return;
    const int q = grid.rankAt(r, c);
    if (q >= 0 && !image.isOneSurface(p, q, {i, j})) return;
    bool is_linked = false, is_over = false, is_refused = false;
    for (int di = -1; di <= 1; ++di) {
      for (int dj = -1; dj <= 1; ++dj) {
        const int a = i + di, b = j + dj;
        if (PixelStep{a, b}.ring() != ring - 1 || reached(a, b) == 0) continue;
        const int m = grid.rankAt(row + a, column + b);
        if (m < 0) {
          is_over = true;
        } else if (q < 0 || image.isOneSurface(m, q, {di, dj})) {
          is_linked = true;
        } else {
          is_refused = true;
        }
      }
    }
    if (!is_linked && (!is_over || is_refused)) return;
    reached(i, j) = 1;
    if (q < 0) return;
    neighbors_.push_back({0, q});
    steps_.push_back({i, j});
  };
  for (int ring = 1; ring <= rings; ++ring) {
    last_ring_ = count();
    for (int i = -ring; i <= ring; ++i) {
      const bool is_end = std::abs(i) == ring;
      for (int j = -ring; j <= ring; j += is_end ? 1 : 2 * ring) visit(ring, i, j);
    }
  }
  measure(image, p);
}

void PixelWindow::measure(const DepthImage& image, int p) {
  offsets_.take(image.moved, p, neighbors_);
  const Offsets d = offsets_.view();
  for (int i = 0; i < d.count; ++i)
    neighbors_[i].squared_distance = d.x[i] * d.x[i] + d.y[i] * d.y[i] + d.z[i] * d.z[i];
}

double PixelWindow::nearestInLastRing() const {
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = last_ring_; i < count(); ++i) nearest = std::min(nearest, neighbors_[i].squared_distance);
  return nearest;
}

double PixelWindow::nearestInLastRows() const {
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = last_ring_; i < count(); ++i)
    if (std::abs(steps_[i].row) == rings_) nearest = std::min(nearest, neighbors_[i].squared_distance);
  return nearest;
}

}  // namespace tufted
