#include "depth_image/range_fit.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "depth_image/rim_fit.h"
#include "depth_image/window_pixels.h"

namespace tufted {
namespace {

constexpr double harmless = 1e-4;   // of the squared spacing; a hundredth of it does not matter for L
constexpr double rounding = 1e-10;  // of an inverse depth; less is no noise, as from a sensor that is far away
constexpr double most_misfit = 3;   // variance of residuals, in variances of the noise
// Values that were smoothed before have bounds of their own, in the variance that their noise is expected to leave.
constexpr double most_misfit_apart = 8;           // of a quadratic over 7 x 7 or 5 x 5 values
constexpr double most_misfit_of_planes = 4;       // of planes over a part of either
constexpr double further_share = 1.0 / 8;         // of the variance that a fit to values apart leaves
constexpr double further_share_nearer = 1.0 / 4;  // over 5 x 5
constexpr double most_share_of_bent = 0.25;       // of a quadratic over a part of 7 x 7
constexpr double most_misfit_to_bend = 6;         // of a plane over 5 x 5, times most_misfit_of_planes
constexpr double steepest_bend_squared = 64;      // change of a plane from value to value, in variances of the noise
constexpr int least_of_bent = 28;                 // values of a quadratic over a part of 7 x 7, that of p included
constexpr int least_of_wide = 20;                 // pixels of a plane over 7 x 7, that of p included
constexpr int least_of_narrow = 12;               // over 5 x 5
constexpr double steep_squared = 1;               // change per pixel, in variances of the noise
constexpr double steep_rim_squared = 2;           // where a rim may be
constexpr double least_lean = 0.4;                // pixels from the middle one up the slope to the mean of all
constexpr double most_gap = 1;                    // pixels from the last one to the silhouette
constexpr double most_loss = 3;                   // variances, of all residuals to those of a quadratic
constexpr int terms_of_quadratic = 6;

/// Variance of the value in the middle, by that of each pixel.
template <int Reach>
double quadraticLeverage() {
  const double pixels = (2 * Reach + 1) * (2 * Reach + 1);
  const double mean_square = Reach * (Reach + 1) / 3.0;
  const double bowl = pixels * mean_square * ((3.0 * Reach * (Reach + 1) - 1) / 5 - mean_square);
  return 1 / pixels + 2 * mean_square * mean_square / bowl;
}

/// The inverse depth of a pixel of the window, less that of the middle one.
double rise(const PixelRows& ranges, const PixelStep& step) {
  return ranges.at[step.row * ranges.row_step + step.column * ranges.column_step] - ranges.at[0];
}

/// A plane or a quadratic over some pixels of the window.
struct PartFit {
  double value, variance;  ///< as SquareFit
  double leverage;         ///< variance of the value, by that of each pixel

  std::optional<SmoothedRange> within(double most_variance) const {
    if (!std::isfinite(value) || !(variance <= most_variance)) return std::nullopt;
    return SmoothedRange{value, leverage * std::max(variance, most_variance / most_misfit)};
  }
};

struct PlaneFit : PartFit {
  double along_rows, along_columns;  ///< its slope
  double slope_squared;              ///< how much a pixel changes it
  double rise;                       ///< of it from the middle pixel to the mean of all
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
  const double rise = (rows * along_rows + columns * along_columns) / count;
  return PlaneFit{{ranges.at[0] + value, variance, share * of_all}, along_rows, along_columns, slope_squared, rise};
}

/// The products of powers of its row and column, up to the fourth together, for every step of a window.
struct StepPowers {
  static constexpr int most = 4, size = 16;  // 15 products, filled up to whole packets
  using Products = std::array<std::int16_t, size>;

  std::array<Products, WindowPixels::count> of{};
  Products of_all{1};  ///< the sum over a whole window

  /// Where the product of so many rows and columns is.
  static constexpr int at(int rows, int columns) { return rows * (2 * most + 3 - rows) / 2 + columns; }

  constexpr StepPowers() {
    for (int i = 0; i < WindowPixels::count; ++i) {
      const PixelStep& step = window_pixels.step[i];
      for (int rows = 0, by_row = 1; rows <= most; ++rows, by_row *= step.row)
        for (int columns = 0, both = by_row; columns <= most - rows; ++columns, both *= step.column)
          of[i][at(rows, columns)] = static_cast<std::int16_t>(both);
      for (int j = 0; j < size; ++j) of_all[j] = static_cast<std::int16_t>(of_all[j] + of[i][j]);
    }
  }
};

constexpr StepPowers step_powers;

/// The sums over some pixels of a window and the middle one. They are whole numbers, so that those of the pixels that
/// are left out, mostly fewer, can be taken from the whole.
StepPowers::Products momentsOf(std::uint64_t around) {
  StepPowers::Products moments = step_powers.of_all;
  forEachPixel(WindowPixels::rings(WindowPixels::reach) & ~around, [&](int pixel) {
    for (int i = 0; i < StepPowers::size; ++i)
      moments[i] = static_cast<std::int16_t>(moments[i] - step_powers.of[pixel][i]);
  });
  return moments;
}

/// A quadratic over some pixels of the window: at least least_of_wide, which no conic holds.
std::optional<PartFit> fitQuadratic(const PixelRows& ranges, std::uint64_t around) {
  constexpr std::array<PixelStep, terms_of_quadratic> terms = {
      {{0, 2}, {1, 1}, {2, 0}, {0, 1}, {1, 0}, {0, 0}}};  // powers
  constexpr int unknowns = terms.size();
  const int constant = unknowns - 1, values = unknowns;
  const int count = std::popcount(around) + 1;
  if (count < least_of_wide) return std::nullopt;
  const StepPowers::Products moments = momentsOf(around);
  // The lower triangle of the products of all terms and the values.
  std::array<std::array<double, unknowns + 1>, unknowns + 1> left;
  for (int i = 0; i < unknowns; ++i)
    for (int j = 0; j <= i; ++j)
      left[i][j] = moments[StepPowers::at(terms[i].row + terms[j].row, terms[i].column + terms[j].column)];
  double all = 0, by_row = 0, by_column = 0, by_rows = 0, by_both = 0, by_columns = 0, squares = 0;
  forEachPixel(around, [&](int pixel) {
    const PixelStep& step = window_pixels.step[pixel];
    const double row = step.row, column = step.column, w = rise(ranges, step);
    const double row_w = row * w, column_w = column * w;
    all += w;
    by_row += row_w;
    by_column += column_w;
    by_rows += row * row_w;
    by_both += row * column_w;
    by_columns += column * column_w;
    squares += w * w;
  });
  left[values] = {by_columns, by_both, by_rows, by_column, by_row, all, squares};
  // Term by term but for the constant is eliminated. Of the constant and the values then that is left which the other
  // terms do not explain.
  for (int i = 0; i < constant; ++i) {
    const double inverse = 1 / left[i][i];
    for (int j = i + 1; j <= values; ++j) {
      const double share = left[j][i] * inverse;
      for (int k = i + 1; k <= j; ++k) left[j][k] -= share * left[k][i];
    }
  }
  const double leverage = 1 / left[constant][constant], value = left[values][constant] * leverage;
  const double variance = std::max(0.0, left[values][values] - value * left[values][constant]) / (count - unknowns);
  return PartFit{ranges.at[0] + value, variance, leverage};
}

/// The surface that ends at a rim, where pixels are missing down a steep slope, the silhouette is found no
/// farther than the next pixel, and a quadratic explains hardly more. On flat surfaces, which may end there as well, a
/// quadratic has less noise than what is found by chance.
std::optional<PartFit> fitAtRim(const PixelRows& ranges, std::uint64_t around, const PlaneFit& plane,
                                const PartFit& quadratic, double known) {
  const double slope = std::sqrt(plane.slope_squared);
  if (!(plane.slope_squared > steep_rim_squared * known && plane.rise > least_lean * slope)) return std::nullopt;
  const auto rim = fitRim(ranges, around, plane.along_rows, plane.along_columns, std::sqrt(known));
  if (!rim || !(rim->gap <= most_gap && rim->leverage <= 1)) return std::nullopt;
  const int free = std::popcount(around) + 1 - terms_of_quadratic;
  if (!(rim->misfits <= free * quadratic.variance + most_loss * known)) return std::nullopt;
  return PartFit{rim->value, rim->misfits / free, rim->leverage};
}

/// At an edge: a plane, but a quadratic where the surface goes along the line of sight by more than noise from pixel to
/// pixel, or up to a rim what goes like a root. A body that curves away from the sensor is steep up to its rim, and a
/// plane would cut that off.
std::optional<SmoothedRange> fitAtEdge(const PixelRows& ranges, std::uint64_t around, int least_pixels, double known) {
  const double most_variance = most_misfit * known;
  const std::optional<PlaneFit> plane = fitPlane(ranges, around, least_pixels);
  if (!plane) return std::nullopt;
  if (plane->slope_squared > steep_squared * known)
    if (const auto quadratic = fitQuadratic(ranges, around)) {
      if (const auto rim = fitAtRim(ranges, around, *plane, *quadratic, known))
        if (const auto range = rim->within(most_variance)) return SmoothedRange{range->inverse, range->variance, true};
      if (const auto bent = quadratic->within(most_variance)) return bent;
    }
  return plane->within(most_variance);
}

}  // namespace

bool needsSmoothing(double inverse_range, double noise, double spacing_squared) {
  return noise * noise > harmless * spacing_squared && noise > rounding * inverse_range;
}

std::optional<SmoothedRange> smoothedInverseDepth(const PixelRows& ranges, std::uint64_t around,
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
  if (!(narrow.variance <= most_misfit_apart * noise_variance)) return std::nullopt;
  return SmoothedRange{narrow.value, before.variance * further_share_nearer};
}

std::optional<SmoothedRange> smoothedFurther(const PixelRows& ranges, std::uint64_t around, const SmoothedRange& before,
                                             double noise_variance, bool may_bend) {
  const double most_variance = most_misfit_of_planes * noise_variance;
  const auto wide = fitPlane(ranges, around, least_of_wide);
  if (wide && wide->within(most_variance)) return SmoothedRange{wide->value, before.variance * further_share};
  const auto narrow = fitPlane(ranges, around & WindowPixels::rings(2), least_of_narrow);
  if (!narrow) return std::nullopt;
  if (narrow->within(most_variance)) return SmoothedRange{narrow->value, before.variance * further_share_nearer};
  // Most of the others lie at creases, or along the sight at rims, where the first fit was a quadratic.
  if (!may_bend || !wide || std::popcount(around) + 1 < least_of_bent) return std::nullopt;
  if (!(narrow->variance <= most_misfit_to_bend * most_variance)) return std::nullopt;
  if (!(wide->slope_squared <= steepest_bend_squared * noise_variance)) return std::nullopt;
  const auto bent = fitQuadratic(ranges, around);
  if (!bent || !bent->within(most_variance) || !(bent->leverage <= most_share_of_bent)) return std::nullopt;
  return SmoothedRange{bent->value, before.variance * std::max(further_share, bent->leverage)};
}

}  // namespace tufted
