#include "depth_image/smoothed_ranges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "depth_image/window_pixels.h"

namespace tufted {
namespace {

constexpr std::array<int, 2> strides = {3, 9};
constexpr double tolerance = 2;    // standard deviations of noise between two smoothed values
constexpr double harmless = 0.01;  // of the squared spacing: a tenth of it in noise

/// Inverse ranges pixel by pixel, not a number where there is none.
Buffer<double> asImage(const PixelGrid& grid, const RawBuffer<SmoothedRange>& range) {
  Buffer<double> image(grid.rank.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t p = 0; p < range.size(); ++p)
    if (grid.pixel[p] >= 0) image[grid.pixel[p]] = range[p].inverse;
  return image;
}

/// The values of the pixels of a window that are `stride` apart, and which of them may be of one surface with the
/// middle: those that differ from it by no more than a slope and noise explain.
class PixelsApart {
 public:
  using Values = std::array<double, WindowPixels::side() * WindowPixels::side()>;
  static constexpr int middle() { return WindowPixels::count / 2; }

  PixelsApart(const PixelGrid& grid, const Buffer<double>& inverse, double most_noise, int stride)
      : grid_(grid), inverse_(inverse), tolerance_(most_noise), stride_(stride) {
    for (int i = 0; i < WindowPixels::count; ++i) {
      const auto [row, column] = window_pixels.step[i];
      shift_[i] = stride * (std::int64_t{row} * grid.columns + column);
      place_[i] = middle() + WindowPixels::side() * row + column;
    }
  }

  /// @param spacing of neighbouring pixels, in inverse range
  std::uint64_t take(std::int64_t pixel, double spacing, Values& values) const {
    const std::int64_t row = pixel / grid_.columns, column = pixel % grid_.columns;
    const std::int64_t reach = WindowPixels::reach * std::int64_t{stride_};
    const bool is_inside =
        row >= reach && column >= reach && row + reach < grid_.rows && column + reach < grid_.columns;
    const double here = values[middle()] = inverse_[pixel];
    std::uint64_t around = 0;
    for (int ring = 1, i = 0; ring <= WindowPixels::reach; ++ring) {
      const double most = steepest * spacing * stride_ * ring + tolerance_;
      for (; i < WindowPixels::inRings(ring); ++i) {
        const double value = is_inside || holds(row, column, i) ? inverse_[pixel + shift_[i]] : 0;
        values[place_[i]] = value;
        around |= static_cast<std::uint64_t>(std::abs(value - here) <= most) << i;
      }
    }
    return around;
  }

 private:
  static constexpr double steepest = 4;  // pixels along the line of sight for one across

  bool holds(std::int64_t row, std::int64_t column, int i) const {
    const std::int64_t r = row + stride_ * window_pixels.step[i].row,
                       c = column + stride_ * window_pixels.step[i].column;
    return r >= 0 && c >= 0 && r < grid_.rows && c < grid_.columns;
  }

  const PixelGrid& grid_;
  const Buffer<double>& inverse_;
  double tolerance_;
  int stride_;
  std::array<std::int64_t, WindowPixels::count> shift_;
  std::array<int, WindowPixels::count> place_;
};

}  // namespace

void smoothFurther(const PixelGrid& grid, SmoothedRanges& smoothed, double noise, const Workers& workers) {
  for (const int stride : strides) {
    const Buffer<double> before = asImage(grid, smoothed.range);
    const PixelsApart apart(grid, before, tolerance * noise, stride);
    workers.forBlocks(
        "windows", std::ssize(smoothed.range), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
          PixelsApart::Values values;
          for (std::int64_t p = begin; p < end; ++p) {
            SmoothedRange& range = smoothed.range[p];
            if (!(range.variance > harmless * smoothed.spacing_squared[p])) continue;
            const std::uint64_t set = apart.take(grid.pixel[p], std::sqrt(smoothed.spacing_squared[p]), values);
            range = smoothedFurther({values.data() + PixelsApart::middle(), WindowPixels::side()}, set, range, noise);
          }
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
