#include "depth_image/faint_jumps.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/buffer.h"
#include "depth_image/range_fit.h"
#include "depth_image/window_halves.h"
#include "simd/kernels.h"

namespace tufted {
namespace {

// Bounds of jumps are multiples of what noise alone shows as a jump, at all but a tenth of the pixels.
constexpr double least_found = 3.5;  // a jump that a line starts at
constexpr double least_jump = 1.4;   // one where it goes on
constexpr double steepest = 64;      // squared tangent of 83 degrees, beside the slopes of both sides
constexpr double most_pixels = 0.9;
constexpr double of_white_noise = 0.91;  // what noise makes there, in its standard deviations, if pixels differ freely
constexpr std::size_t samples = 500;     // pixels
constexpr int reach = WindowPixels::reach;

// What four pixels in a row contribute to the value of their line half a pixel before the first of them.
constexpr std::array<double, reach + 1> at_the_end = {0.85, 0.45, 0.05, -0.35};

class JumpFollower {
 public:
  JumpFollower(const PixelGrid& grid, const PointsView& points, const RangeNoise& noise, SurfaceWindows& windows,
               SmoothedRanges& smoothed)
      : grid_(grid), points_(points), noise_(noise), windows_(windows), smoothed_(smoothed) {}

  void run() {
    findRefused();
    if (steps_.empty()) return;
    refused_ = steps_.size();
    findTypical();
    for (std::size_t i = 0; i < steps_.size(); ++i) follow(i);
    if (steps_.size() == refused_) return;
    cutCorners();
    cutWindows();
  }

 private:
  /// A step to the next pixel that leads over a jump.
  struct Step {
    std::int64_t pixel;  ///< where it starts
    Direction direction;
    bool leads_away;  ///< from the sensor
  };

  std::int64_t shiftOf(const PixelStep& step) const { return std::int64_t{step.row} * grid_.columns + step.column; }
  std::int64_t along(Direction direction) const { return direction == right ? grid_.columns : 1; }
  std::int64_t across(Direction direction) const { return direction == right ? 1 : grid_.columns; }
  static double signOf(const Step& step) { return step.leads_away ? 1 : -1; }
  bool isCut(std::int64_t pixel, Direction direction) const { return (cut_[pixel] >> direction & 1) != 0; }
  double inverseAt(std::int64_t pixel) const {
    const int p = grid_.rank[pixel];
    return p < 0 ? std::numeric_limits<double>::quiet_NaN() : 1 / grid_.depthOf(points_.row(p));
  }
  double noiseAt(std::int64_t pixel) const { return noise_.atInverse(inverseAt(pixel)); }
  double typicalAt(std::int64_t pixel) const { return typical_ * noiseAt(pixel); }

  void findRefused() {
    const std::array<std::uint64_t, 2> bit = {std::uint64_t{1} << window_pixels.numberOf({0, 1}),
                                              std::uint64_t{1} << window_pixels.numberOf({1, 0})};
    for (std::size_t p = 0; p < windows_.around.size(); ++p) {
      const std::uint64_t around = windows_.around[p];
      const std::int64_t pixel = grid_.pixel[p];
      if ((around & bit[0]) != 0 && (around & bit[1]) != 0) continue;
      if (pixel < 0) continue;
      for (const Direction direction : {right, down}) {
        const int q = grid_.rank[pixel + across(direction)];
        if ((around & bit[direction]) != 0 || q < 0) continue;
        add({pixel, direction, windows_.range[q] > windows_.range[p]});
      }
    }
  }

  /// What noise makes of a jump. In real cameras it is alike in neighbouring pixels, and steps of a coarse depth are
  /// longer than a window, so that a mean over pixels has less of it gone.
  void findTypical() {
    const std::size_t stride = std::max<std::size_t>(1, windows_.around.size() / samples) | 1;
    Buffer<double> jumps;
    jumps.reserve(2 * (windows_.around.size() / stride + 1));
    for (std::size_t p = 0; p < windows_.around.size(); p += stride) {
      if (windows_.around[p] != WindowPixels::rings(reach)) continue;
      const std::int64_t pixel = grid_.pixel[p];
      if (!needsSmoothing(inverseAt(pixel), noiseAt(pixel), smoothed_.spacing_squared[smoothedAt(pixel)])) continue;
      for (const Direction direction : {right, down}) {
        const double jump = std::abs(straightJump({pixel, direction, true})) / noiseAt(pixel);
        if (std::isfinite(jump)) jumps.push_back(jump);
      }
    }
    if (jumps.empty()) return;
    const auto at = jumps.begin() + static_cast<std::ptrdiff_t>(most_pixels * static_cast<double>(jumps.size()));
    std::nth_element(jumps.begin(), at, jumps.end());
    typical_ = std::max(typical_, *at);
  }

  void add(const Step& step) {
    if (cut_.empty()) cut_.assign(grid_.rank.size(), 0);
    cut_[step.pixel] |= static_cast<std::uint8_t>(1 << step.direction);
    steps_.push_back(step);
  }

  /// How much larger the inverse depth is on this side of a line across a row than beyond, by lines over four pixels on
  /// either side.
  double jumpOfRow(std::int64_t pixel, Direction direction) const {
    double sum = 0;
    for (int j = 0; j <= reach; ++j)
      sum +=
          at_the_end[j] * (inverseAt(pixel - j * across(direction)) - inverseAt(pixel + (j + 1) * across(direction)));
    return sum;
  }

  /// The mean, but if positive no more than twice that of all but the largest and the smallest: a single pixel may be
  /// anything.
  static double robustMean(const std::array<double, WindowPixels::side()>& values) {
    double sum = 0, least = values[0], most = values[0];
    for (const double value : values) {
      sum += value;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    const double mean = sum / WindowPixels::side();
    return mean > 0 ? std::min(mean, 2 * (sum - least - most) / (WindowPixels::side() - 2)) : mean;
  }

  /// How much larger the inverse depth is on the near side of a straight line, by the mean of the rows within reach.
  double straightJump(const Step& step) const {
    std::array<double, WindowPixels::side()> rows;
    for (int i = -reach; i <= reach; ++i)
      rows[i + reach] = signOf(step) * jumpOfRow(step.pixel + i * along(step.direction), step.direction);
    return robustMean(rows);
  }

  /// The same, but the line may be aslant: before or after the row it lies a pixel aside where that makes the jump
  /// larger, but not both times on the same side.
  double jumpAt(const Step& step) const {
    std::array<std::array<double, WindowPixels::side()>, 3> rows;  // of a line -1, 0 and 1 pixel aside
    std::array<std::array<double, 2>, 3> sums{};                   // before and after the row
    for (const int aside : {-1, 0, 1}) {
      for (int i = -reach; i <= reach; ++i) {
        const std::int64_t pixel = step.pixel + i * along(step.direction) + aside * across(step.direction);
        const double jump = signOf(step) * jumpOfRow(pixel, step.direction);
        rows[aside + 1][i + reach] = jump;
        if (i != 0) sums[aside + 1][i < 0 ? 0 : 1] += jump;
      }
    }
    std::array<int, 2> best = {1, 1};
    for (const std::array<int, 2>& line : {std::array{0, 1}, {2, 1}, {1, 0}, {1, 2}, {0, 2}, {2, 0}})
      if (sums[line[0]][0] + sums[line[1]][1] > sums[best[0]][0] + sums[best[1]][1]) best = line;
    std::array<double, WindowPixels::side()> along_line = rows[1];
    std::copy_n(rows[best[0]].begin(), reach, along_line.begin());
    std::copy_n(rows[best[1]].end() - reach, reach, along_line.end() - reach);
    return robustMean(along_line);
  }

  /// Whether a step that was not refused leads over a jump as well.
  bool leadsOver(const Step& step) const {
    const std::int64_t next = step.pixel + across(step.direction);
    const int p = grid_.rank[step.pixel], q = grid_.rank[next];
    if (p < 0 || q < 0) return false;
    const std::uint64_t missing_before = window_halves.before[step.direction] & ~windows_.around[p];
    if ((missing_before | (window_halves.after[step.direction] & ~windows_.around[q])) != 0) return false;
    const double spacing_squared = smoothed_.spacing_squared[smoothedAt(step.pixel)];
    if (!needsSmoothing(inverseAt(step.pixel), noiseAt(step.pixel), spacing_squared)) return false;
    const double jump = jumpAt(step), least = least_jump * typicalAt(step.pixel);
    if (!(jump > least && jump * jump > steepest * spacing_squared)) return false;
    // The line is one step wide.
    const std::int64_t previous = step.pixel - across(step.direction);
    return !(straightJump({previous, step.direction, step.leads_away}) > jump) &&
           !(straightJump({next, step.direction, step.leads_away}) > jump);
  }

  /// Whether all pixels that jumpAt() reads are of the image or its margins.
  bool isWellInside(std::int64_t pixel) const {
    const std::int64_t row = pixel / grid_.columns;
    return row > reach && row + reach + 2 < grid_.rows;
  }

  /// Looks for the line on either side of a step. A pixel that noise alone refused starts none.
  void follow(std::size_t number) {
    const Step step = steps_[number];
    bool is_known = number >= refused_;
    for (const int forward : {-1, 1}) {
      for (const int aside : {-1, 0, 1}) {
        const Step next{step.pixel + forward * along(step.direction) + aside * across(step.direction), step.direction,
                        step.leads_away};
        if (isCut(next.pixel, next.direction) || !leadsOver(next)) continue;
        if (!is_known && !(isWellInside(step.pixel) && jumpAt(step) > least_found * typicalAt(step.pixel))) return;
        is_known = true;
        add(next);
      }
    }
  }

  /// Where a line goes on one pixel aside, the step between both pixels crosses it as well: so do both ways around.
  void cutCorners() {
    Buffer<Step> corners;
    for (std::size_t i = refused_; i < steps_.size(); ++i) {
      const Step& step = steps_[i];
      const Direction other = step.direction == right ? down : right;
      for (const std::int64_t start : {step.pixel, step.pixel + across(step.direction)})
        for (const std::int64_t pixel : {start, start - across(other)})
          if (!isCut(pixel, other) && crosses(pixel, other)) corners.push_back({pixel, other, step.leads_away});
    }
    for (const Step& step : corners)
      if (!isCut(step.pixel, step.direction)) add(step);
  }

  bool crosses(std::int64_t pixel, Direction direction) const {
    const Direction other = direction == right ? down : right;
    const std::int64_t next = pixel + across(direction), side = across(other);
    const auto isCutBeside = [&](std::int64_t start, std::int64_t end, std::int64_t shift, std::int64_t beside) {
      return isCut(start + shift, other) || isCut(end + shift, other) || isCut(pixel + beside, direction);
    };
    return isCutBeside(pixel, next, 0, side) && isCutBeside(pixel, next, -side, -side);
  }

  void cutWindows() {
    Buffer<std::int64_t> pixels;
    for (std::size_t i = refused_; i < steps_.size(); ++i) {
      const Step& step = steps_[i];
      for (const std::int64_t end : {step.pixel, step.pixel + across(step.direction)}) {
        pixels.push_back(end);
        for (const PixelStep& away : window_pixels.step) pixels.push_back(end + shiftOf(away));
      }
    }
    std::sort(pixels.begin(), pixels.end());
    pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
    for (const std::int64_t pixel : pixels) {
      const int p = grid_.rank[pixel];
      if (p < 0) continue;
      const std::uint64_t before = windows_.around[p], after = reachedFrom(pixel, before);
      if (before == after) continue;
      windows_.cut += std::popcount(before) - std::popcount(after);
      windows_.around[p] = after;
      smoothAgain(pixel, after);
    }
  }

  /// The pixels of a window to which steps from ring to ring lead without crossing a line.
  std::uint64_t reachedFrom(std::int64_t pixel, std::uint64_t window) const {
    constexpr int side = WindowPixels::side();
    std::array<std::uint8_t, side * side> is_reached{};
    const auto at = [](int row, int column) { return (row + reach) * side + column + reach; };
    is_reached[at(0, 0)] = 1;
    std::uint64_t reached = 0;
    for (int i = 0; i < WindowPixels::count; ++i) {
      const auto [row, column] = window_pixels.step[i];
      const int ring = window_pixels.step[i].ring();
      const bool is_open = grid_.rank[pixel + shiftOf({row, column})] < 0;
      if (!is_open && (window >> i & 1) == 0) continue;
      bool is_linked = false;
      for (int down_by = -1; down_by <= 1; ++down_by) {
        for (int right_by = -1; right_by <= 1; ++right_by) {
          const PixelStep from{row - down_by, column - right_by};
          if (from.ring() != ring - 1 || is_reached[at(from.row, from.column)] == 0) continue;
          is_linked = is_linked || !isCut(pixel + shiftOf(from), PixelStep{down_by, right_by});
        }
      }
      if (!is_linked) continue;
      is_reached[at(row, column)] = 1;
      if (!is_open) reached |= std::uint64_t{1} << i;
    }
    return reached;
  }

  /// Whether a step to one of the eight pixels beside crosses a line; a diagonal one does if both ways around do.
  bool isCut(std::int64_t pixel, const PixelStep& step) const {
    const std::int64_t above = pixel + std::min<std::int64_t>(0, step.row) * grid_.columns;
    const std::int64_t left = pixel + std::min(0, step.column);
    if (step.row == 0) return isCut(left, right);
    if (step.column == 0) return isCut(above, down);
    const std::int64_t row_shift = std::int64_t{step.row} * grid_.columns;
    return (isCut(left, right) || isCut(above + step.column, down)) &&
           (isCut(above, down) || isCut(left + row_shift, right));
  }

  std::ptrdiff_t smoothedAt(std::int64_t pixel) const { return smoothed_.atPixel(grid_, pixel); }

  void smoothAgain(std::int64_t pixel, std::uint64_t around) {
    constexpr int side = WindowPixels::side(), row_step = side + kernel_packet;
    std::array<double, side * row_step> inverse{};  // packets of pixels, of which the first is looked at
    const int middle = reach * row_step + reach;
    inverse[middle] = inverseAt(pixel);
    forEachPixel(around, [&](int i) {
      const auto [row, column] = window_pixels.step[i];
      inverse[middle + row * row_step + column] = inverseAt(pixel + shiftOf({row, column}));
    });
    const std::ptrdiff_t at = smoothedAt(pixel);
    SmoothedRange range{inverse[middle], 0};
    const PixelRows rows{inverse.data() + middle, row_step, 1};
    const double noise = noise_.atInverse(inverse[middle]);
    const bool has_neighbors = (around & WindowPixels::rings(1)) != 0;
    if (has_neighbors && needsSmoothing(inverse[middle], noise, smoothed_.spacing_squared[at])) {
      SquareFits narrow{};
      if ((around & WindowPixels::rings(2)) == WindowPixels::rings(2)) kernels().fitSquares5(rows, narrow);
      range = smoothedInverseDepth(rows, around, {narrow.value[0], narrow.variance[0]}, {}, noise).value_or(range);
    }
    smoothed_.inverse[at] = range.inverse;
    smoothed_.variance[at] = range.variance;
    windows_.at_rim[grid_.rank[pixel]] = range.at_rim ? 1 : 0;
  }

  const PixelGrid& grid_;
  PointsView points_;
  RangeNoise noise_;
  SurfaceWindows& windows_;
  SmoothedRanges& smoothed_;
  double typical_ = of_white_noise;  ///< jump, in standard deviations of the noise; see findTypical()
  Buffer<std::uint8_t> cut_;         ///< by pixel, a bit per Direction; empty without any
  Buffer<Step> steps_;               ///< over jumps: those that were refused before, then those that are found
  std::size_t refused_ = 0;          ///< how many were refused
};

}  // namespace

void cutFaintJumps(const PixelGrid& grid, const PointsView& points, const RangeNoise& noise, SurfaceWindows& windows,
                   SmoothedRanges& smoothed) {
  if (grid.goes_round) return;
  JumpFollower(grid, points, noise, windows, smoothed).run();
}

}  // namespace tufted
