#include "depth_image/range_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "depth_image/window_pixels.h"

namespace tufted {
namespace {

constexpr double harmless = 1e-4;   // of the squared spacing; a hundredth of it does not matter for L
constexpr double rounding = 1e-10;  // of an inverse range; less is no noise, as from a sensor that is far away
constexpr double most_misfit = 3;   // variance of residuals, in variances of the noise
// Values that were smoothed before have bounds of their own, in variances of what noise they still have.
constexpr double most_misfit_apart = 16;          // of a quadratic over 7 x 7 values
constexpr double most_misfit_apart_nearer = 8;    // of one over 5 x 5
constexpr double most_misfit_of_planes = 4;       // of planes over a part of either
constexpr double further_share = 1.0 / 8;         // of the variance that a fit to values apart leaves
constexpr double further_share_nearer = 1.0 / 4;  // over 5 x 5
constexpr int least_of_wide = 20;                 // pixels of a plane over 7 x 7, that of p included
constexpr int least_of_narrow = 12;               // over 5 x 5
constexpr double steep_squared = 1;               // change per pixel, in variances of the noise

/// Variance of the value in the middle, by that of each pixel.
template <int Reach>
double quadraticLeverage() {
  const double pixels = (2 * Reach + 1) * (2 * Reach + 1);
  const double mean_square = Reach * (Reach + 1) / 3.0;
  const double bowl = pixels * mean_square * ((3.0 * Reach * (Reach + 1) - 1) / 5 - mean_square);
  return 1 / pixels + 2 * mean_square * mean_square / bowl;
}

/// The inverse range of a pixel of the window, less that of the middle one.
double rise(const PixelRows& ranges, const PixelStep& step) {
  return ranges.at[step.row * ranges.row_step + step.column * ranges.column_step] - ranges.at[0];
}

/// A plane over some pixels of the window.
struct PlaneFit {
  double value, variance;  ///< as SquareFit
  double leverage;         ///< variance of the value, by that of each pixel
  double slope_squared;    ///< how much a pixel changes it

  std::optional<SmoothedRange> within(double most_variance) const {
    if (!std::isfinite(value) || !(variance <= most_variance)) return std::nullopt;
    return SmoothedRange{value, leverage * std::max(variance, most_variance / most_misfit)};
  }
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
  // The inverse of the moments by their cofactors, which are whole numbers.
  const int of_all = rows_rows * columns_columns - rows_columns * rows_columns;
  const int of_row = columns * rows_columns - rows * columns_columns;
  const int of_column = rows * rows_columns - columns * rows_rows;
  const double share = 1.0 / (count * of_all + rows * of_row + columns * of_column);  // so many are not on one line
  const double value = share * (of_all * all + of_row * by_row + of_column * by_column);
  const double along_rows = share * (of_row * all + (count * columns_columns - columns * columns) * by_row +
                                     (rows * columns - count * rows_columns) * by_column);
  const double along_columns = share * (of_column * all + (rows * columns - count * rows_columns) * by_row +
                                        (count * rows_rows - rows * rows) * by_column);
  const double explained = value * all + along_rows * by_row + along_columns * by_column;
  const double variance = std::max(0.0, squares - explained) / (count - 3);
  const double slope_squared = along_rows * along_rows + along_columns * along_columns;
  return PlaneFit{ranges.at[0] + value, variance, share * of_all, slope_squared};
}

/// The products of powers of its row and column, each up to the fourth, for every step of a window.
struct StepPowers {
  static constexpr int sides = 5, size = 32;  // of 25, filled up to whole packets
  using Products = std::array<std::int16_t, size>;

  std::array<Products, WindowPixels::count> of{};

  constexpr StepPowers() {
    for (int i = 0; i < WindowPixels::count; ++i) {
      const PixelStep& step = window_pixels.step[i];
      for (int row = 0, by_row = 1; row < sides; ++row, by_row *= step.row)
        for (int column = 0, both = by_row; column < sides - row; ++column, both *= step.column)
          of[i][row * sides + column] = static_cast<std::int16_t>(both);
    }
  }
};

constexpr StepPowers step_powers;

/// A quadratic over some pixels of the window: at least least_of_wide, which no conic holds.
std::optional<SmoothedRange> fitQuadratic(const PixelRows& ranges, std::uint64_t around, double most_variance) {
  constexpr std::array<PixelStep, 6> terms = {{{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}}};  // powers
  constexpr int unknowns = terms.size();
  const int count = std::popcount(around) + 1;
  if (count < least_of_wide) return std::nullopt;
  StepPowers::Products products{1};  // of the middle
  Eigen::Matrix<double, unknowns, 2> sides = Eigen::Matrix<double, unknowns, 2>::Zero();
  double squares = 0;
  forEachPixel(around, [&](int pixel) {
    const PixelStep& step = window_pixels.step[pixel];
    const double row = step.row, column = step.column, w = rise(ranges, step);
    for (int i = 0; i < StepPowers::size; ++i) products[i] += step_powers.of[pixel][i];
    sides(0, 0) += w;
    sides(1, 0) += row * w;
    sides(2, 0) += column * w;
    sides(3, 0) += row * row * w;
    sides(4, 0) += row * column * w;
    sides(5, 0) += column * column * w;
    squares += w * w;
  });
  Eigen::Matrix<double, unknowns, unknowns> moments;
  for (int i = 0; i < unknowns; ++i)
    for (int j = 0; j < unknowns; ++j)
      moments(i, j) = products[(terms[i].row + terms[j].row) * StepPowers::sides + terms[i].column + terms[j].column];
  sides(0, 1) = 1;
  // With the triangular factor of the moments all that is asked for is a product of these two.
  const Eigen::LLT<Eigen::Matrix<double, unknowns, unknowns>> factor(moments);
  factor.matrixL().solveInPlace(sides);
  const double value = sides.col(1).dot(sides.col(0)), leverage = sides.col(1).squaredNorm();
  const double variance = std::max(0.0, squares - sides.col(0).squaredNorm()) / (count - unknowns);
  if (!std::isfinite(value) || !(variance <= most_variance)) return std::nullopt;
  return SmoothedRange{ranges.at[0] + value, leverage * std::max(variance, most_variance / most_misfit)};
}

/// At an edge: a plane, but a quadratic where the surface goes along the line of sight by more than noise from pixel to
/// pixel. A body that curves away from the sensor does so up to its rim, and a plane would cut that off.
std::optional<SmoothedRange> fitAtEdge(const PixelRows& ranges, std::uint64_t around, int least_pixels, double known) {
  const double most_variance = most_misfit * known;
  const std::optional<PlaneFit> plane = fitPlane(ranges, around, least_pixels);
  if (!plane) return std::nullopt;
  if (plane->slope_squared > steep_squared * known)
    if (const auto quadratic = fitQuadratic(ranges, around, most_variance)) return quadratic;
  return plane->within(most_variance);
}

}  // namespace

bool needsSmoothing(double inverse_range, double noise, double spacing_squared) {
  return noise * noise > harmless * spacing_squared && noise > rounding * inverse_range;
}

std::optional<SmoothedRange> smoothedInverseRange(const PixelRows& ranges, std::uint64_t around,
                                                  const SquareFit& narrow, const SquareFit& wide, double noise) {
  const std::uint64_t inner = WindowPixels::rings(2), whole = WindowPixels::rings(3);
  const double known = noise * noise;
  if ((around & inner) != inner) {
    if (const auto fit = fitAtEdge(ranges, around, least_of_wide, known)) return fit;
    return fitAtEdge(ranges, around & inner, least_of_narrow, known);
  }
  const double variance = std::max(narrow.variance, known);  // on one step of a coarse depth there is no residual
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
  if (!(narrow.variance <= most_misfit_apart_nearer * noise_variance)) return std::nullopt;
  return SmoothedRange{narrow.value, before.variance * further_share_nearer};
}

std::optional<SmoothedRange> smoothedFurther(const PixelRows& ranges, std::uint64_t around, const SmoothedRange& before,
                                             double noise_variance) {
  const double most_variance = most_misfit_of_planes * noise_variance;
  const auto planeOver = [&](std::uint64_t pixels, int least_pixels, double share) -> std::optional<SmoothedRange> {
    const auto plane = fitPlane(ranges, pixels, least_pixels);
    if (!plane || !plane->within(most_variance)) return std::nullopt;
    return SmoothedRange{plane->value, before.variance * share};
  };
  if (const auto plane = planeOver(around, least_of_wide, further_share)) return plane;
  return planeOver(around & WindowPixels::rings(2), least_of_narrow, further_share_nearer);
}

}  // namespace tufted
