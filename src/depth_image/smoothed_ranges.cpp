#include "depth_image/smoothed_ranges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "depth_image/window_pixels.h"
#include "simd/kernels.h"

namespace tufted {
namespace {

constexpr std::array<int, 2> strides = {3, 9};
constexpr double tolerance = 2;    // standard deviations of noise between two smoothed values
constexpr double harmless = 0.01;  // of the squared spacing: a tenth of it in noise
constexpr double steepest = 4;     // pixels along the line of sight for one across

/// Smooths an image again by values that are some pixels apart: those around a pixel that differ from its own by no
/// more than a slope and noise explain may be of one surface with it.
class RangeSmoother {
 public:
  RangeSmoother(const PixelGrid& grid, double noise, int stride, SmoothedRanges& smoothed)
      : grid_(grid), noise_(noise), stride_(stride), reach_(WindowPixels::reach * stride), smoothed_(smoothed) {
    inverse_.assign(grid.rank.size() + 2 * static_cast<std::size_t>(room()), std::numeric_limits<double>::quiet_NaN());
    double* const image = inverse_.data() + room();
    for (std::size_t p = 0; p < smoothed.range.size(); ++p)
      if (grid.pixel[p] >= 0) image[grid.pixel[p]] = smoothed.range[p].inverse;
  }

  void smoothRow(int row) const {
    for (int column = PixelGrid::margin; column < grid_.columns - PixelGrid::margin; column += kernel_packet)
      smoothSome(row, column);
  }

 private:
  using Slopes = std::array<double, kernel_packet>;

  /// What packets read beyond both ends of the image.
  int room() const { return reach_ + kernel_packet; }
  const double* inverseAt(int row, int column) const { return inverse_.data() + room() + pixelAt(row, column); }
  std::int64_t pixelAt(int row, int column) const { return std::int64_t{row} * grid_.columns + column; }

  void smoothSome(int row, int column) const {
    const int count = std::min(kernel_packet, grid_.columns - PixelGrid::margin - column);
    const int* const rank = grid_.rank.data() + pixelAt(row, column);
    Slopes slope{};
    unsigned is_wanted = 0;
    for (int lane = 0; lane < count; ++lane) {
      const int p = rank[lane];
      if (p < 0 || !(smoothed_.range[p].variance > harmless * smoothed_.spacing_squared[p])) continue;
      is_wanted |= 1U << lane;
      slope[lane] = steepest * std::sqrt(smoothed_.spacing_squared[p]) * stride_;
    }
    if (is_wanted == 0) return;
    const PixelRows rows{inverseAt(row, column), std::ptrdiff_t{stride_} * grid_.columns, stride_};
    const unsigned is_whole = is_wanted & wholeWindows(row, column, rows, slope);
    SquareFits fits{};
    if (is_whole != 0) kernels().fitSquares7(rows, fits);
    for (int lane = 0; lane < count; ++lane) {
      if ((is_wanted >> lane & 1U) == 0) continue;
      SmoothedRange& range = smoothed_.range[rank[lane]];
      if ((is_whole >> lane & 1U) != 0) {
        range = smoothedFurther({fits.value[lane], fits.variance[lane]}, range, noise_);
      } else {
        const PixelRows around{rows.at + lane, rows.row_step, rows.column_step};
        range = smoothedFurther(around, joined(row, column + lane, around, slope[lane]), range, noise_);
      }
    }
  }

  /// The lanes whose windows are of one surface, as bits.
  unsigned wholeWindows(int row, int column, const PixelRows& rows, const Slopes& slope) const {
    if (row < reach_ || row + reach_ >= grid_.rows) return 0;
    unsigned is_inside = 0;
    for (int lane = 0; lane < kernel_packet; ++lane)
      if (column + lane >= reach_ && column + lane + reach_ < grid_.columns) is_inside |= 1U << lane;
    return is_inside == 0 ? 0 : is_inside & kernels().squaresWithin(rows, slope.data(), tolerance * noise_);
  }

  /// The pixels of a window that are of one surface with the middle.
  std::uint64_t joined(int row, int column, const PixelRows& ranges, double slope) const {
    std::uint64_t around = 0;
    for (int i = 0; i < WindowPixels::count; ++i) {
      const PixelStep& step = window_pixels.step[i];
      const int r = row + stride_ * step.row, c = column + stride_ * step.column;
      if (r < 0 || c < 0 || r >= grid_.rows || c >= grid_.columns) continue;
      const double value = ranges.at[step.row * ranges.row_step + step.column * ranges.column_step];
      const bool is_joined = std::abs(value - ranges.at[0]) <= slope * step.ring() + tolerance * noise_;
      around |= static_cast<std::uint64_t>(is_joined) << i;
    }
    return around;
  }

  const PixelGrid& grid_;
  double noise_;
  int stride_, reach_;
  SmoothedRanges& smoothed_;
  Buffer<double> inverse_;  ///< before
};

}  // namespace

void smoothFurther(const PixelGrid& grid, SmoothedRanges& smoothed, double noise, const Workers& workers) {
  for (const int stride : strides) {
    const RangeSmoother smoother(grid, noise, stride, smoothed);
    const std::int64_t rows_at_once = std::max<std::int64_t>(1, usual_block / grid.columns);
    workers.forBlocks("windows", grid.rows, rows_at_once, [&](std::int64_t begin, std::int64_t end, int) {
      for (auto row = static_cast<int>(begin); row < end; ++row) smoother.smoothRow(row);
    });
  }
}

PointBuffer displacementsAlongRays(const PixelGrid& grid, const PointsView& points, const SmoothedRanges& smoothed,
                                   const Workers& workers, std::int64_t& moved) {
  PointBuffer displacement;
  displacement.setZero(points.rows());
  Buffer<std::int64_t> counts(workers.count());
  workers.forBlocks("windows", points.rows(), usual_block, [&](std::int64_t begin, std::int64_t end, int worker) {
    for (std::int64_t p = begin; p < end; ++p) {
      const Eigen::RowVector3d ray = points.row(p) - grid.origin;
      const double share = 1 / (ray.norm() * smoothed.range[p].inverse) - 1;
      if (!(smoothed.range[p].variance > 0) || share == 0 || !std::isfinite(share)) continue;
      displacement.row(p) = share * ray;
      ++counts[worker];
    }
  });
  moved = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  return displacement;
}

}  // namespace tufted
