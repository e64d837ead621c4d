#include "depth_image/smoothed_ranges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>

#include "base/median.h"
#include "depth_image/window_pixels.h"
#include "simd/kernels.h"

namespace tufted {
namespace {

/// Pixels between the values of a fit, pass by pass: fits are 19 and 55 pixels wide, as a wall 8 m away has noise of 12
/// spacings, then 31 and 13. With 3, 9, 4 an office has 79.9 instead of 82.1 % of triangles from all corners.
constexpr std::array<int, 4> strides = {3, SmoothedRanges::widest_stride, 5, 2};
/// Values are not smoothed further if their variance is below this share of the squared spacing, noise of 1/50 of it.
/// With 1/20 normals are off by 0.17 instead of 0.07 degrees, with 1/100 a wall behind a ball by 0.64 instead of 0.53
/// mm.
constexpr double harmless_variance = 0.0004;
/// Number of sampled packets of eight pixels from which the remaining noise is measured; 2,000 give the same.
constexpr std::int64_t sampled_packets = 500;
/// Quantile of the residual variances that is only noise, as half of the windows may hold a crease.
constexpr double quiet = 0.25;
/// Quantile of the residual variances that shows the steps of a coarse depth, which most windows of a terrace do not
/// contain. Without it a room in steps of 1/8 has 23 instead of 2 % too much area.
constexpr double usual = 0.75;
/// Quantile `usual` exceeds `quiet` by at most this factor if there is only noise: 1.5 for white noise, 2 to 3 for real
/// cameras. With 3 a room in steps has 1.7 instead of 0.8 % too much area.
constexpr double most_to_usual = 2;
/// The first pass expects at most this share of the variance of the noise, and no pass expects more than the one
/// before.
constexpr double left_at_first = 1;
/// White noise leaves at least this share of its variance in the quiet windows after one smoothing (0.016 to 0.018);
/// the steps of a coarse depth on a ball leave less (0.008).
constexpr double least_of_white = 0.012;
// For white noise the remaining share is known and not measured: a bound of half of it excludes shape better.

/// Greatest share of the variance of the noise that a pass expects fits to leave, half of what the first one leaves:
/// with more, rims are cut off.
constexpr double left_of_white = 0.03;
/// Share of the variance of the smoothed value that a pass expects, half of the 0.8 that each pass leaves. With 0.8 a
/// room has 35 instead of 22 edges across jumps, with 0.3 it has 4.5 instead of 3.7 % of its area off.
constexpr double share_of_white = 0.4;

/// Calls work(row, worker) for all rows, including the border.
template <class Work>
void forEachRow(const SmoothedRanges& image, const Workers& workers, const Work& work) {
  const std::int64_t rows = image.rows + 2 * SmoothedRanges::border;
  const std::int64_t rows_at_once = std::max<std::int64_t>(1, usual_block / image.columns);
  workers.forBlocks("windows", rows, rows_at_once, [&](std::int64_t begin, std::int64_t end, int worker) {
    for (std::int64_t row = begin; row < end; ++row) work(static_cast<int>(row) - SmoothedRanges::border, worker);
  });
}

/// Fills the border left and right of an image that goes round.
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

/// The variance that fits to values around a pixel are expected to leave if these are of one surface.
struct VarianceLeft {
  double least = 0, most = 0;  ///< in variances of the noise
  double share = 0;            ///< share of the variance of the pixel's value

  /// @param variance of the value of the pixel. A pixel that was never smoothed has neighbours that were not either. At
  /// edges its value has more variance than theirs, hence the bounds.
  double at(double variance, double noise_squared) const {
    return std::max(least * noise_squared, std::min(most * noise_squared, share * variance));
  }
};

/// One pass: smooths an image by values some pixels apart, namely those that differ from the value of a pixel by no
/// more than a slope and noise explain.
class RangeSmoother {
 public:
  /// @param[out] after inverse depths
  RangeSmoother(const RangeNoise& noise, int stride, SmoothedRanges& smoothed, RawBuffer<double>& after)
      : noise_(noise), stride_(stride), smoothed_(smoothed), after_(after) {
    for (int i = 0; i < WindowPixels::count; ++i) {
      const PixelStep& step = window_pixels.step[i];
      shift_[i] = stride * (step.row * smoothed.row_step + step.column);
    }
  }

  /// Measures by fits all over the image what noise leaves, at most what it left before. Noise of real cameras is
  /// similar in neighbouring pixels and survives smoothing, unlike white noise. The steps of a coarse depth are in some
  /// windows only.
  void find(VarianceLeft& left) const {
    Samples samples = takeSamples();
    if (!samples.left.empty()) {
      const double quietly_left = quantileOf(samples.left, quiet);
      left.least = std::min(left.least, std::max(quietly_left, quantileOf(samples.left, usual) / most_to_usual));
      left.share = left.least / quantileOf(samples.before, 0.5);
    }
    if (left.most == 0) left.most = left.least;  // set by the first pass
  }

  /// Whether fits with a stride of 1 leave at least what white noise leaves, a 60th of it, as smoothing has made values
  /// similar over 7 x 7 pixels. Shape leaves more.
  bool leavesNoise() const {
    Samples samples = takeSamples();
    return !samples.left.empty() && quantileOf(samples.left, quiet) >= least_of_white;
  }

  void smoothRow(int row, const VarianceLeft& left) const {
    const std::ptrdiff_t begin = smoothed_.at(row, -SmoothedRanges::border), end = begin + smoothed_.row_step;
    std::copy(smoothed_.inverse.begin() + begin, smoothed_.inverse.begin() + end, after_.begin() + begin);
    if (row < 0 || row >= smoothed_.rows) return;
    for (int column = PixelGrid::margin; column < smoothed_.columns - PixelGrid::margin; column += kernel_packet)
      smoothSome(smoothed_.at(row, column), left);
  }

 private:
  /// Samples of whole windows all over the image, in variances of the noise.
  struct Samples {
    Buffer<double> left;    ///< variance of the residuals
    Buffer<double> before;  ///< variance of the value in the middle
  };

  Samples takeSamples() const {
    const int in_row = (smoothed_.columns - 2 * PixelGrid::margin + kernel_packet - 1) / kernel_packet;
    const std::int64_t packets = std::int64_t{in_row} * (smoothed_.rows - 2 * PixelGrid::margin);
    const std::int64_t step = sampleStride(packets, sampled_packets, in_row);
    Samples taken;
    for (Buffer<double>* const values : {&taken.left, &taken.before})
      values->reserve(static_cast<std::size_t>((packets / step + 1) * kernel_packet));
    for (std::int64_t i = 0; i < packets; i += step) {
      const int row = PixelGrid::margin + static_cast<int>(i / in_row);
      const int column = PixelGrid::margin + static_cast<int>(i % in_row) * kernel_packet;
      const Packet packet = fit(smoothed_.at(row, column));
      for (int lane = 0; lane < kernel_packet; ++lane)
        if (((packet.is_wanted & packet.is_whole) >> lane & 1U) != 0) {
          const std::ptrdiff_t at = smoothed_.at(row, column) + lane;
          const double noise = noise_.atInverse(smoothed_.inverse[at]);
          taken.left.push_back(packet.wide.variance[lane] / (noise * noise));
          taken.before.push_back(smoothed_.variance[at] / (noise * noise));
        }
    }
    return taken;
  }

  /// The windows of a packet of pixels.
  struct Packet {
    unsigned is_wanted = 0, is_whole = 0;
    std::array<unsigned char, WindowPixels::count> within;
    SquareFits wide{};
  };

  PixelRows rowsAt(std::ptrdiff_t at) const {
    return {smoothed_.inverse.data() + at, stride_ * smoothed_.row_step, stride_};
  }

  Packet fit(std::ptrdiff_t at) const {
    Packet packet;
    std::array<double, kernel_packet> slope, tolerance;
    for (int lane = 0; lane < kernel_packet; ++lane) {
      const double spacing_squared = smoothed_.spacing_squared[at + lane];
      packet.is_wanted |= static_cast<unsigned>(smoothed_.variance[at + lane] > harmless_variance * spacing_squared)
                          << lane;
    }
    if (packet.is_wanted == 0) return packet;
    for (int lane = 0; lane < kernel_packet; ++lane) {
      slope[lane] = smoothed_.steepestSlope(at + lane) * stride_;
      tolerance[lane] = SmoothedRanges::tolerance * noise_.atInverse(smoothed_.inverse[at + lane]);
    }
    packet.is_whole = kernels().squaresWithin(smoothed_.inverse.data() + at, shift_.data(), slope.data(),
                                              tolerance.data(), packet.is_wanted, packet.within.data());
    if ((packet.is_wanted & packet.is_whole) != 0) kernels().fitSquares7(rowsAt(at), packet.wide);
    return packet;
  }

  void smoothSome(std::ptrdiff_t at, const VarianceLeft& left) const {
    const Packet packet = fit(at);
    if (packet.is_wanted == 0) return;
    const PixelRows rows = rowsAt(at);
    SquareFits narrow;
    bool has_narrow = false;
    for (int lane = 0; lane < kernel_packet; ++lane) {
      if ((packet.is_wanted >> lane & 1U) == 0) continue;
      const SmoothedRange before{rows.at[lane], smoothed_.variance[at + lane]};
      const double noise = noise_.atInverse(before.inverse), variance = left.at(before.variance, noise * noise);
      std::optional<SmoothedRange> range;
      if ((packet.is_whole >> lane & 1U) != 0) {
        range = smoothedFurther({packet.wide.value[lane], packet.wide.variance[lane]}, before, variance);
        if (!range) {
          if (!has_narrow) kernels().fitSquares5(rows, narrow);
          has_narrow = true;
          range = smoothedNearer({narrow.value[lane], narrow.variance[lane]}, before, variance);
        }
      } else {
        std::uint64_t around = 0;
        for (int i = 0; i < WindowPixels::count; ++i) around |= std::uint64_t{packet.within[i] >> lane & 1U} << i;
        range = smoothedFurther({rows.at + lane, rows.row_step, rows.column_step}, around, before, variance);
      }
      if (!range) continue;
      after_[at + lane] = range->inverse;
      smoothed_.variance[at + lane] = range->variance;
    }
  }

  RangeNoise noise_;
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

void smoothFurther(const RangeNoise& noise, bool changes_sides, const Workers& workers, SmoothedRanges& smoothed) {
  RawBuffer<double> after(smoothed.inverse.size());
  std::fill_n(after.end() - kernel_packet, kernel_packet, 0);
  const bool is_white = changes_sides && RangeSmoother(noise, 1, smoothed, after).leavesNoise();
  VarianceLeft left{.least = left_at_first};
  if (is_white) left = {.most = left_of_white, .share = share_of_white};
  for (const int stride : strides) {
    if (smoothed.goes_round) {
      // A scanner has few rings: 55 of them are most of the image, and no longer one surface.
      if (stride == SmoothedRanges::widest_stride) continue;
      repeatBeyondSeam(smoothed, workers);
    }
    const RangeSmoother smoother(noise, stride, smoothed, after);
    if (!is_white) smoother.find(left);
    forEachRow(smoothed, workers, [&](int row, int) { smoother.smoothRow(row, left); });
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
    std::int64_t moved_here = 0;
    for (int column = PixelGrid::margin; column < grid.columns - PixelGrid::margin; ++column) {
      const int p = grid.rank[std::int64_t{row} * grid.columns + column];
      if (p < 0) continue;
      const std::ptrdiff_t at = smoothed.at(row, column);
      const double share = 1 / (grid.depthOf(points.row(p)) * smoothed.inverse[at]) - 1;
      const bool moves = smoothed.variance[at] > 0 && share != 0 && std::isfinite(share);
      moved_here += moves ? 1 : 0;
      if (moves) {
        move(p, share * (points.row(p) - grid.origin));
      } else {
        move(p, Eigen::RowVector3d::Zero());
      }
    }
    moved[worker] += moved_here;
  });
  for (int p = 0; p < static_cast<int>(points.rows()); ++p)
    if (grid.pixel[p] < 0) move(p, Eigen::RowVector3d::Zero());
  windows.moved = std::accumulate(moved.begin(), moved.end(), std::int64_t{0});
}

}  // namespace tufted
