#include "depth_image/rim_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "depth_image/window_pixels.h"

namespace tufted {
namespace {

enum Unknown { level, slope, rise, offset, turn, bend, unknowns };
using Vector = Eigen::Matrix<double, unknowns, 1>;
using Matrix = Eigen::Matrix<double, unknowns, unknowns>;

constexpr std::array<double, 3> first_gaps = {0.1, 0.4, 1};  // pixels from the last pixel to the silhouette
constexpr double least_rise = 1;                             // deviations of noise in the first pixel
constexpr double least_root = 0.1;                           // deviations; pixels beyond the silhouette are at it
constexpr double usual_bend = 0.005;  // of silhouettes, per squared pixel: a radius of 100 pixels
constexpr int most_rounds = 3;
constexpr double least_gain = 0.1;  // variances; a round that gains less is the last
constexpr double first_damping = 1e-3;
constexpr double damping_change = 5;
constexpr double singular = 1e-9;  // share of the diagonal that is added before an inverse

/// The pixels of a part of a window in the directions of a rim.
class RimPixels {
 public:
  /// @param row,column the direction across, into the body
  RimPixels(const PixelRows& ranges, std::uint64_t around, double row, double column, double noise) {
    const auto add = [&](const PixelStep& step) {
      across_[count_] = row * step.row + column * step.column;
      along_[count_] = row * step.column - column * step.row;
      value_[count_] =
          (ranges.at[step.row * ranges.row_step + step.column * ranges.column_step] - ranges.at[0]) / noise;
      first_ = std::min(first_, across_[count_]);
      ++count_;
    };
    add({0, 0});
    forEachPixel(around, [&](int pixel) { add(window_pixels.step[pixel]); });
  }

  /// Where across the last pixel before the silhouette is.
  double first() const { return first_; }

  /// The best fit with a straight silhouette, so many pixels beyond the last one.
  Vector start() const {
    Vector best = Vector::Zero();
    double most = -std::numeric_limits<double>::infinity();
    for (const double gap : first_gaps) {
      double along = 0, root = 0, value = 0, along_along = 0, along_root = 0, root_root = 0, along_value = 0,
             root_value = 0;
      for (int i = 0; i < count_; ++i) {
        const double square = across_[i] - first_ + gap, r = std::sqrt(square), t = along_[i], w = value_[i];
        along += t;
        root += r;
        value += w;
        along_along += t * t;
        along_root += t * r;
        root_root += square;
        along_value += t * w;
        root_value += r * w;
      }
      const double share = 1.0 / count_;
      along_along -= share * along * along;
      along_root -= share * along * root;
      root_root -= share * root * root;
      along_value -= share * along * value;
      root_value -= share * root * value;
      const double determinant = along_along * root_root - along_root * along_root;
      const double c = std::max(least_rise, (root_value * along_along - along_value * along_root) / determinant);
      const double b = (along_value - along_root * c) / along_along;
      const double explained = along_value * b + root_value * c;
      if (!(explained > most)) continue;
      most = explained;
      best << share * (value - along * b - root * c), b, c, gap - first_, 0, 0;
    }
    return best;
  }

  /// The squares of all residuals, and that of the bend by how much is usual.
  double misfits(const Vector& x) const {
    double sum = bend_weight * x[bend] * x[bend];
    for (int i = 0; i < count_; ++i) {
      const double residual = residualOf(x, i, rootOf(x, i));
      sum += residual * residual;
    }
    return sum;
  }

  /// The normal equations for a step, those of the left side below the diagonal. The changes of a pixel with the
  /// unknowns are 1, t, r, s, s t and s t^2, where r is the root, t goes along the rim and 2 r s is the rise.
  void linearize(const Vector& x, Matrix& left, Vector& right) const {
    double t_sum = 0, tt_sum = 0, r_sum = 0, rt_sum = 0, rr_sum = 0;
    std::array<double, 4> s_sum{};   // times powers of t
    std::array<double, 5> ss_sum{};  // the same
    right.setZero();
    for (int i = 0; i < count_; ++i) {
      const double r = rootOf(x, i), t = along_[i], s = x[rise] / (2 * r), rest = residualOf(x, i, r);
      t_sum += t;
      tt_sum += t * t;
      r_sum += r;
      rt_sum += r * t;
      rr_sum += r * r;
      double power = 1;
      for (int k = 0; k < 5; ++k, power *= t) {
        if (k < 4) s_sum[k] += s * power;
        ss_sum[k] += s * s * power;
      }
      right += rest * (Vector() << 1, t, r, s, s * t, s * t * t).finished();
    }
    const double half = x[rise] / 2;
    left.setZero();
    left.row(level)[level] = count_;
    left.row(slope).head(2) << t_sum, tt_sum;
    left.row(rise).head(3) << r_sum, rt_sum, rr_sum;
    left.row(offset).head(4) << s_sum[0], s_sum[1], half * count_, ss_sum[0];
    left.row(turn).head(5) << s_sum[1], s_sum[2], half * t_sum, ss_sum[1], ss_sum[2];
    left.row(bend) << s_sum[2], s_sum[3], half * tt_sum, ss_sum[2], ss_sum[3], ss_sum[4] + bend_weight;
    right[bend] -= bend_weight * x[bend];
  }

  /// The root of the distance from the silhouette. The first pixel is the middle of the window.
  double rootOf(const Vector& x, int i) const {
    const double least = least_root / x[rise], t = along_[i];
    return std::sqrt(std::max(across_[i] + x[offset] + (x[turn] + x[bend] * t) * t, least * least));
  }

 private:
  static constexpr double bend_weight = 1 / (usual_bend * usual_bend);

  double residualOf(const Vector& x, int i, double root) const {
    return value_[i] - x[level] - x[slope] * along_[i] - x[rise] * root;
  }

  int count_ = 0;
  double first_ = 0;
  std::array<double, WindowPixels::count + 1> across_, along_;
  std::array<double, WindowPixels::count + 1> value_;  ///< less that of the middle, in deviations of noise
};

Eigen::LLT<Matrix> factorOf(Matrix left, double damping) {
  left.diagonal() *= 1 + damping;
  return left.llt();
}

}  // namespace

std::optional<RimFit> fitRim(const PixelRows& ranges, std::uint64_t around, double along_rows, double along_columns,
                             double noise) {
  const double steepness = std::sqrt(along_rows * along_rows + along_columns * along_columns);
  const RimPixels pixels(ranges, around, along_rows / steepness, along_columns / steepness, noise);
  Vector x = pixels.start();
  Matrix left;
  Vector right;
  pixels.linearize(x, left, right);
  double misfits = pixels.misfits(x), damping = first_damping;
  for (int round = 0; round < most_rounds; ++round) {
    const Vector next = x + factorOf(left, damping).solve(right);
    const double then = next[rise] > 0 ? pixels.misfits(next) : misfits;
    if (!(then < misfits)) {
      damping *= damping_change;
      continue;
    }
    const double gain = misfits - then;
    x = next;
    misfits = then;
    pixels.linearize(x, left, right);
    if (gain < least_gain) break;
    damping /= damping_change;
  }
  const double root = pixels.rootOf(x, 0);
  Vector change;
  change << 1, 0, root, x[rise] / (2 * root), 0, 0;
  const double value = x[level] + x[rise] * root, leverage = change.dot(factorOf(left, singular).solve(change));
  if (!std::isfinite(value) || !std::isfinite(leverage)) return std::nullopt;
  return RimFit{ranges.at[0] + noise * value, noise * noise * misfits, leverage, x[offset] + pixels.first()};
}

}  // namespace tufted
