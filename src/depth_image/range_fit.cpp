#include "depth_image/range_fit.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "depth_image/window_pixels.h"

namespace tufted {
namespace {

/// Noise whose variance is below this share of the squared spacing does nothing to L and is not smoothed.
constexpr double harmless_noise = 1e-4;
/// Noise below this share of the inverse depth is rounding, as from a sensor far away, and is not smoothed.
constexpr double noise_rounding = 1e-10;
/// A fit is rejected if the variance of its residuals exceeds this many variances of the noise. With 1.5 an office has
/// 67 instead of 68 % of its triangles from all three corners: neighbouring pixels of real cameras have the same noise.
constexpr double most_misfit = 3;
// Values that were smoothed before have bounds of their own, in units of the variance that their noise is expected to
// leave.

/// Greatest variance of the residuals of a quadratic over 7 x 7 or 5 x 5 such values. With 16 a room in steps has 3.2
/// instead of 2.6 % of its area off, with 4 a ball in steps has normals off by 0.56 instead of 0.34 degrees.
constexpr double most_misfit_apart = 8;
/// Greatest variance of the residuals of a plane over a part of a window of such values. With 8 points of a ball are
/// off by 0.24 instead of 0.21 mm, with 2 a room has 9 instead of 4 % too much area.
constexpr double most_misfit_of_planes = 4;
/// Share of the variance of the values that a fit to 7 x 7 of them is assumed to leave; a quadratic leaves 0.1.
constexpr double further_share = 1.0 / 8;
/// Share of the variance of the values that a fit to 5 x 5 of them is assumed to leave; a quadratic leaves 0.15.
constexpr double further_share_nearer = 1.0 / 4;
/// Least number of pixels of a plane over a part of 7 x 7, its own included: two fifths.
constexpr int least_of_wide = 20;
/// Least number of pixels of a plane over a part of 5 x 5: half.
constexpr int least_of_narrow = 12;
// A plane at an edge is too steep if its squared change per pixel exceeds `steep_by_noise` variances of the noise,
// twice what noise makes, and `steep_by_spacing` squared spacings, which is 63 degrees.
constexpr double steep_by_noise = 2, steep_by_spacing = 4;

/// Variance of the fitted value in the middle over that of each pixel.
template <int Reach>
double quadraticLeverage() {
  const double pixels = (2 * Reach + 1) * (2 * Reach + 1);
  const double mean_square = Reach * (Reach + 1) / 3.0;
  const double bowl = pixels * mean_square * ((3.0 * Reach * (Reach + 1) - 1) / 5 - mean_square);
  return 1 / pixels + 2 * mean_square * mean_square / bowl;
}

/// The inverse depth of a pixel of the window minus that of the middle one.
double rise(const PixelRows& ranges, const PixelStep& step) {
  return ranges.at[step.row * ranges.row_step + step.column * ranges.column_step] - ranges.at[0];
}

/// A plane or a quadratic over some pixels of the window.
struct PartFit {
  double value, variance;  ///< see SquareFit
  double leverage;         ///< variance of the value over that of each pixel

  std::optional<SmoothedRange> within(double most_variance) const {
    if (!std::isfinite(value) || !(variance <= most_variance)) return std::nullopt;
    return SmoothedRange{value, leverage * std::max(variance, most_variance / most_misfit)};
  }
};

struct PlaneFit : PartFit {
  double slope_squared;  ///< squared change per pixel
};

std::optional<PlaneFit> fitPlane(const PixelRows& ranges, std::uint64_t around, int least_pixels) {
  const int count = std::popcount(around) + 1;
  if (count < least_pixels) return std::nullopt;
  double all = 0, by_row = 0, by_column = 0, squares = 0;
  int rows = 0, columns = 0, rows_rows = 0, rows_columns = 0, columns_columns = 0;
  forEachPixel(around, [&](int pixel) {
    const auto [row, column] = window_pixels.step[pixel];
    const double w = rise(ranges, {row, column});
    all += w;
    by_row += row * w;
    by_column += column * w;
    squares += w * w;
    rows += row;
    columns += column;
    rows_rows += row * row;
    rows_columns += row * column;
    columns_columns += column * column;
  });
  // The inverse of the moments by their cofactors, which are integers.
  const int of_all = rows_rows * columns_columns - rows_columns * rows_columns;
  const int of_row = columns * rows_columns - rows * columns_columns;
  const int of_column = rows * rows_columns - columns * rows_rows;
  // `least_pixels` are never on one line
  const double share = 1.0 / (count * of_all + rows * of_row + columns * of_column);
  const double value = share * (of_all * all + of_row * by_row + of_column * by_column);
  const double along_rows = share * (of_row * all + (count * columns_columns - columns * columns) * by_row +
                                     (rows * columns - count * rows_columns) * by_column);
  const double along_columns = share * (of_column * all + (rows * columns - count * rows_columns) * by_row +
                                        (count * rows_rows - rows * rows) * by_column);
  const double explained = value * all + along_rows * by_row + along_columns * by_column;
  const double variance = std::max(0.0, squares - explained) / (count - 3);
  const double slope_squared = along_rows * along_rows + along_columns * along_columns;
  return PlaneFit{{ranges.at[0] + value, variance, share * of_all}, slope_squared};
}

/// A plane over the part of a window at an edge. Not if it is so steep, beyond what noise explains, that the surface is
/// that of a body which curves away from the sensor: a plane would cut off its rim.
std::optional<SmoothedRange> fitAtEdge(const PixelRows& ranges, std::uint64_t around, int least_pixels, double known,
                                       double spacing_squared) {
  const double steep = std::max(steep_by_noise * known, steep_by_spacing * spacing_squared);
  const std::optional<PlaneFit> plane = fitPlane(ranges, around, least_pixels);
  if (!plane || plane->slope_squared > steep) return std::nullopt;
  return plane->within(most_misfit * known);
}

}  // namespace

bool needsSmoothing(double inverse_range, double noise, double spacing_squared) {
  return noise * noise > harmless_noise * spacing_squared && noise > noise_rounding * inverse_range;
}

std::optional<SmoothedRange> smoothedInverseDepth(const PixelRows& ranges, std::uint64_t around,
                                                  const SquareFit& narrow, const SquareFit& wide, double noise,
                                                  double spacing_squared) {
  const std::uint64_t inner = WindowPixels::rings(2), whole = WindowPixels::rings(3);
  const double known = noise * noise;
  if ((around & inner) != inner) {
    if (const auto fit = fitAtEdge(ranges, around, least_of_wide, known, spacing_squared)) return fit;
    return fitAtEdge(ranges, around & inner, least_of_narrow, known, spacing_squared);
  }
  const double variance = std::max(narrow.variance, known);  // residuals are 0 on one step of a coarse depth
  if (around == whole && wide.variance <= most_misfit * variance)
    return SmoothedRange{wide.value, quadraticLeverage<3>() * std::max(wide.variance, known)};
  return SmoothedRange{narrow.value, quadraticLeverage<2>() * variance};
}

std::optional<SmoothedRange> smoothedFurther(const SquareFit& wide, const SmoothedRange& before,
                                             double noise_variance) {
  if (!(wide.variance <= most_misfit_apart * noise_variance)) return std::nullopt;
  return SmoothedRange{wide.value, before.variance * further_share};
}

std::optional<SmoothedRange> smoothedNearer(const SquareFit& narrow, const SmoothedRange& before,
                                            double noise_variance) {
  if (!(narrow.variance <= most_misfit_apart * noise_variance)) return std::nullopt;
  return SmoothedRange{narrow.value, before.variance * further_share_nearer};
}

std::optional<SmoothedRange> smoothedFurther(const PixelRows& ranges, std::uint64_t around, const SmoothedRange& before,
                                             double noise_variance) {
  const double most_variance = most_misfit_of_planes * noise_variance;
  const auto wide = fitPlane(ranges, around, least_of_wide);
  if (wide && wide->within(most_variance)) return SmoothedRange{wide->value, before.variance * further_share};
  const auto narrow = fitPlane(ranges, around & WindowPixels::rings(2), least_of_narrow);
  if (!narrow || !narrow->within(most_variance)) return std::nullopt;
  return SmoothedRange{narrow->value, before.variance * further_share_nearer};
}

}  // namespace tufted
