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

constexpr std::array<int, 2> strides = {3, SmoothedRanges::widest_stride};
constexpr double tolerance = 2;    // standard deviations of noise between two smoothed values
constexpr double harmless = 0.01;  // of the squared spacing: a tenth of it in noise
constexpr double steepest = 4;     // pixels along the line of sight for one across

/// Calls work(row, worker) for all rows, those of the border too.
template <class Work>
void forEachRow(const SmoothedRanges& image, const Workers& workers, const Work& work) {
  const std::int64_t rows = image.rows + 2 * SmoothedRanges::border;
  const std::int64_t rows_at_once = std::max<std::int64_t>(1, usual_block / image.columns);
  workers.forBlocks("windows", rows, rows_at_once, [&](std::int64_t begin, std::int64_t end, int worker) {
    for (std::int64_t row = begin; row < end; ++row) work(static_cast<int>(row) - SmoothedRanges::border, worker);
  });
}

/// Fills what lies left and right of an image that goes round, as far as windows reach.
void repeatBeyondSeam(SmoothedRanges& image, const Workers& workers) {
  const int first = PixelGrid::margin, around = image.columns - 2 * PixelGrid::margin;
  forEachRow(image, workers, [&](int row, int) {
    if (row < 0 || row >= image.rows) return;
    double* const inverse = image.inverse.data() + image.at(row, 0);
    for (int column = first - 1; column >= -SmoothedRanges::border; --column)
      inverse[column] = inverse[column + around];
    for (int column = first + around; column < image.columns + SmoothedRanges::border; ++column)
      inverse[column] = inverse[column - around];
  });
}

/// Smooths an image again by values that are some pixels apart: those around a pixel that differ from its own by no
/// more than a slope and noise explain may be of one surface with it.
class RangeSmoother {
 public:
  /// @param[out] after inverse ranges
  RangeSmoother(double noise, int stride, SmoothedRanges& smoothed, RawBuffer<double>& after)
      : noise_(noise), stride_(stride), smoothed_(smoothed), after_(after) {
    for (int i = 0; i < WindowPixels::count; ++i) {
      const PixelStep& step = window_pixels.step[i];
      shift_[i] = stride * (step.row * smoothed.row_step + step.column);
    }
  }

  void smoothRow(int row) const {
    const std::ptrdiff_t begin = smoothed_.at(row, -SmoothedRanges::border), end = begin + smoothed_.row_step;
    std::copy(smoothed_.inverse.begin() + begin, smoothed_.inverse.begin() + end, after_.begin() + begin);
    if (row < 0 || row >= smoothed_.rows) return;
    for (int column = PixelGrid::margin; column < smoothed_.columns - PixelGrid::margin; column += kernel_packet)
      smoothSome(smoothed_.at(row, column));
  }

 private:
  void smoothSome(std::ptrdiff_t at) const {
    std::array<double, kernel_packet> slope;
    unsigned is_wanted = 0;
    for (int lane = 0; lane < kernel_packet; ++lane) {
      const double spacing_squared = smoothed_.spacing_squared[at + lane];
      is_wanted |= static_cast<unsigned>(smoothed_.variance[at + lane] > harmless * spacing_squared) << lane;
    }
    if (is_wanted == 0) return;
    for (int lane = 0; lane < kernel_packet; ++lane)
      slope[lane] = steepest * std::sqrt(smoothed_.spacing_squared[at + lane]) * stride_;
    const double* const values = smoothed_.inverse.data() + at;
    const PixelRows rows{values, stride_ * smoothed_.row_step, stride_};
    std::array<unsigned char, WindowPixels::count> within;
    const unsigned is_whole =
        kernels().squaresWithin(values, shift_.data(), slope.data(), tolerance * noise_, is_wanted, within.data());
    SquareFits fits{};
    if ((is_wanted & is_whole) != 0) kernels().fitSquares7(rows, fits);
    for (int lane = 0; lane < kernel_packet; ++lane) {
      if ((is_wanted >> lane & 1U) == 0) continue;
      const SmoothedRange before{values[lane], smoothed_.variance[at + lane]};
      SmoothedRange range;
      if ((is_whole >> lane & 1U) != 0) {
        range = smoothedFurther({fits.value[lane], fits.variance[lane]}, before, noise_);
      } else {
        std::uint64_t around = 0;
        for (int i = 0; i < WindowPixels::count; ++i) around |= std::uint64_t{within[i] >> lane & 1U} << i;
        range = smoothedFurther({rows.at + lane, rows.row_step, rows.column_step}, around, before, noise_);
      }
      after_[at + lane] = range.inverse;
      smoothed_.variance[at + lane] = range.variance;
    }
  }

  double noise_;
  int stride_;
  SmoothedRanges& smoothed_;
  RawBuffer<double>& after_;
  std::array<std::ptrdiff_t, WindowPixels::count> shift_{};
};

}  // namespace

void SmoothedRanges::clear(const PixelGrid& grid, const Workers& workers) {
  rows = grid.rows;
  columns = grid.columns;
  goes_round = grid.goes_round;
  row_step = columns + 2 * border;
  const auto size = static_cast<std::size_t>((rows + 2 * border) * row_step + kernel_packet);
  for (RawBuffer<double>* const values : {&inverse, &variance, &spacing_squared}) values->resize(size);
  forEachRow(*this, workers, [this](int row, int) {
    const std::ptrdiff_t begin = at(row, -border);
    std::fill_n(inverse.begin() + begin, row_step, std::numeric_limits<double>::quiet_NaN());
    std::fill_n(variance.begin() + begin, row_step, 0);
    std::fill_n(spacing_squared.begin() + begin, row_step, 0);
  });
  std::fill_n(inverse.end() - kernel_packet, kernel_packet, 0);
  std::fill_n(variance.end() - kernel_packet, kernel_packet, 0);
  std::fill_n(spacing_squared.end() - kernel_packet, kernel_packet, 0);
}

void smoothFurther(SmoothedRanges& smoothed, double noise, const Workers& workers) {
  RawBuffer<double> after(smoothed.inverse.size());
  std::fill_n(after.end() - kernel_packet, kernel_packet, 0);
  for (const int stride : strides) {
    if (smoothed.goes_round) repeatBeyondSeam(smoothed, workers);
    const RangeSmoother smoother(noise, stride, smoothed, after);
    forEachRow(smoothed, workers, [&](int row, int) { smoother.smoothRow(row); });
    smoothed.inverse.swap(after);
  }
}

void moveAlongRays(const PixelGrid& grid, const PointsView& points, const SmoothedRanges& smoothed,
                   const Workers& workers, SurfaceWindows& windows) {
  windows.displacement.resize(points.rows());
  windows.place.resize(points.rows());
  Buffer<std::int64_t> moved(workers.count());
  const auto move = [&](int p, const Eigen::RowVector3d& displacement) {
    windows.displacement.row(p) = displacement;
    windows.place.row(p) = points.row(p) + displacement;
  };
  forEachRow(smoothed, workers, [&](int row, int worker) {
    if (row < 0 || row >= grid.rows) return;
    for (int column = PixelGrid::margin; column < grid.columns - PixelGrid::margin; ++column) {
      const int p = grid.rank[std::int64_t{row} * grid.columns + column];
      if (p < 0) continue;
      const std::ptrdiff_t at = smoothed.at(row, column);
      const double share = 1 / (windows.range[p] * smoothed.inverse[at]) - 1;
      const bool moves = smoothed.variance[at] > 0 && share != 0 && std::isfinite(share);
      moved[worker] += moves ? 1 : 0;
      if (moves) {
        move(p, share * (points.row(p) - grid.origin));
      } else {
        move(p, Eigen::RowVector3d::Zero());
      }
    }
  });
  for (int p = 0; p < static_cast<int>(points.rows()); ++p)
    if (grid.pixel[p] < 0) move(p, Eigen::RowVector3d::Zero());
  windows.moved = std::accumulate(moved.begin(), moved.end(), std::int64_t{0});
}

}  // namespace tufted
