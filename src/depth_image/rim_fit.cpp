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

  /// The normal equations for a step.
  void linearize(const Vector& x, Matrix& left, Vector& right) const {
    left.setZero();
    right.setZero();
    for (int i = 0; i < count_; ++i) {
      const double root = rootOf(x, i), t = along_[i], by_square = x[rise] / (2 * root);
      Vector change;
      change << 1, t, root, by_square, by_square * t, by_square * t * t;
      left.noalias() += change * change.transpose();
      right += residualOf(x, i, root) * change;
    }
    left(bend, bend) += bend_weight;
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
