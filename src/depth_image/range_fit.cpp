#include "depth_image/range_fit.h"

#include <Eigen/Cholesky>
#include <array>
#include <bit>
#include <cmath>

#include "depth_image/window_pixels.h"

namespace tufted {
namespace {

constexpr double harmless = 1e-4;          // of the squared spacing; a hundredth of it does not matter for L
constexpr double rounding = 1e-10;         // of an inverse range; less is no noise, as from a sensor that is far away
constexpr double most_misfit = 3;          // variance of residuals, in variances of the noise
constexpr double most_misfit_apart = 4;    // the same for values that were smoothed before, whose noise is correlated
constexpr double further_share = 1.0 / 8;  // of the variance that a fit to values apart leaves
constexpr int least_of_wide = 20;          // pixels of a plane over 7 x 7, that of p included
constexpr int least_of_narrow = 12;        // over 5 x 5

/// A quadratic over a full square window: its value in the middle and the variance of the residuals.
struct FullFit {
  double value, variance;
};

/// Least squares over {1, i, j, i j, i^2 - m, j^2 - m}, which are orthogonal on the window.
template <int Reach>
FullFit fitFull(const InverseRanges& ranges) {
  const int side = 2 * Reach + 1, pixels = side * side;
  const double mean_square = Reach * (Reach + 1) / 3.0;  // of i
  const double square = pixels * mean_square;            // sum of i^2
  const double fourth = pixels * mean_square * (3.0 * Reach * (Reach + 1) - 1) / 5;
  const double bowl = fourth - pixels * mean_square * mean_square;  // sum of (i^2 - m)^2
  const double saddle = square * square / pixels;                   // sum of (i j)^2

  const double middle = ranges.at[0];
  double all = 0, i = 0, j = 0, ij = 0, ii = 0, jj = 0, squares = 0;
  for (int row = -Reach; row <= Reach; ++row) {
    double sum = 0, first = 0, second = 0;
    for (int column = -Reach; column <= Reach; ++column) {
      const double w = ranges.at[row * ranges.stride + column] - middle;
      sum += w;
      first += column * w;
      second += (column * column - mean_square) * w;
      squares += w * w;
    }
    all += sum;
    i += row * sum;
    ii += (row * row - mean_square) * sum;
    j += first;
    ij += row * first;
    jj += second;
  }
  const double explained =
      all * all / pixels + (i * i + j * j) / square + ij * ij / saddle + (ii * ii + jj * jj) / bowl;
  return {middle + all / pixels - mean_square * (ii + jj) / bowl, std::max(0.0, squares - explained) / (pixels - 6)};
}

/// Variance of the value in the middle, by that of each pixel.
template <int Reach>
double leverage() {
  const double pixels = (2 * Reach + 1) * (2 * Reach + 1);
  const double mean_square = Reach * (Reach + 1) / 3.0;
  const double bowl = pixels * mean_square * ((3.0 * Reach * (Reach + 1) - 1) / 5 - mean_square);
  return 1 / pixels + 2 * mean_square * mean_square / bowl;
}

/// A plane over some pixels of the window.
/// @param most_variance of the residuals
std::optional<SmoothedRange> fitPlane(const InverseRanges& ranges, std::uint64_t around, int least_pixels,
                                      double most_variance) {
  const int count = std::popcount(around) + 1;
  if (count < least_pixels) return std::nullopt;
  const double middle = ranges.at[0];
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0;
  moments(0, 0) = 1;
  forEachPixel(around, [&](int pixel) {
    const auto [row, column] = window_pixels.step[pixel];
    const double w = ranges.at[row * ranges.stride + column] - middle;
    const Eigen::Vector3d base(1, row, column);
    moments += base * base.transpose();
    right += w * base;
    squares += w * w;
  });
  const Eigen::LDLT<Eigen::Matrix3d> factor(moments);
  const Eigen::Vector3d plane = factor.solve(right);
  if (!plane.allFinite()) return std::nullopt;
  const double variance = std::max(0.0, squares - plane.dot(right)) / (count - 3);
  if (!(variance <= most_variance)) return std::nullopt;
  const double leverage = factor.solve(Eigen::Vector3d::UnitX())[0];
  return SmoothedRange{middle + plane[0], leverage * std::max(variance, most_variance / most_misfit)};
}

}  // namespace

std::optional<SmoothedRange> smoothedInverseRange(const InverseRanges& ranges, std::uint64_t around, double noise,
                                                  double spacing_squared) {
  const std::uint64_t inner = WindowPixels::rings(2), whole = WindowPixels::rings(3);
  const double known = noise * noise;
  if (!(known > harmless * spacing_squared) || !(noise > rounding * ranges.at[0])) return std::nullopt;
  if ((around & inner) != inner) {
    if (const auto wide = fitPlane(ranges, around, least_of_wide, most_misfit * known)) return wide;
    return fitPlane(ranges, around & inner, least_of_narrow, most_misfit * known);
  }
  const FullFit narrow = fitFull<2>(ranges);
  const double variance = std::max(narrow.variance, known);  // on one step of a coarse depth there is no residual
  if (around == whole) {
    const FullFit wide = fitFull<3>(ranges);
    if (wide.variance <= most_misfit * variance)
      return SmoothedRange{wide.value, leverage<3>() * std::max(wide.variance, known)};
  }
  return SmoothedRange{narrow.value, leverage<2>() * variance};
}

SmoothedRange smoothedFurther(const InverseRanges& ranges, std::uint64_t around, const SmoothedRange& before,
                              double noise) {
  const double most_variance = most_misfit_apart * noise * noise;
  if (around == WindowPixels::rings(3)) {
    const FullFit wide = fitFull<3>(ranges);
    return wide.variance <= most_variance ? SmoothedRange{wide.value, before.variance * further_share} : before;
  }
  const auto plane = fitPlane(ranges, around, least_of_wide, most_variance);
  return plane ? SmoothedRange{plane->inverse, before.variance * further_share} : before;
}

}  // namespace tufted
