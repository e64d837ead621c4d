#include "depth_image/steep_rim.h"

#include <cmath>
#include <cstdint>

namespace tufted {
namespace {

constexpr double most_noise = 0.01;  // of that step, as JumpTest takes it
constexpr double most_growth = 2.5;  // of the step along the sight; the last one of a root is 2.4 times the one before

/// Whether the step to b is like the one from a point before b, which no jump is.
bool goesOn(const PixelGrid& grid, const PointsView& points, const JumpTest& test, int a, int b) {
  const int before = grid.rank[2 * grid.pixel[a] - grid.pixel[b]];
  if (before < 0) return false;
  const auto range = [&](int p) { return (points.row(p) - grid.origin).norm(); };
  const double first = range(before), middle = range(a), step = range(b) - middle;
  const double step_before = middle - first;
  const double noise = test.tolerance.of_inverse * first * middle + test.tolerance.of_depth;
  return step * step_before > 0 && std::abs(step) <= most_growth * std::abs(step_before) &&
         noise <= most_noise * std::abs(step_before) &&
         test.joins((points.row(a) - points.row(before)).squaredNorm(), first, middle);
}

}  // namespace

bool goesOnToRim(const PixelGrid& grid, const PointsView& points, const JumpTest& test, int a, int b) {
  if (grid.stepBetween(a, b).ring() > PixelGrid::margin) return false;
  return goesOn(grid, points, test, a, b) || goesOn(grid, points, test, b, a);
}

}  // namespace tufted
