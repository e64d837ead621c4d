#include "denoise/rim_profile.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace tufted {
namespace {

constexpr int most_steps = 30;
constexpr double converged = 0.03;  // of the logarithm of the likelihood
constexpr double first_damping = 0.1, least_damping = 1e-6, most_damping = 1e6;
constexpr double whole = 6;         // blurs inside, from which on the surface has all its points
constexpr double smallest = 1e-12;  // of the density: what lies far beyond the curve says no more than that

/// Edge, tilt and bend of the curve; logarithms of the density and of the line.
using Parameters = Eigen::Matrix<double, 5, 1>;
using Information = Eigen::Matrix<double, 5, 5>;

struct Value {
  double logarithm;
  Parameters gradient;
  Information information;  ///< sum of the squares of what each point adds to the gradient
};

/// The likelihood of the points of a strip, as those of a Poisson process.
Value likelihoodOf(const RimStrip& strip, double blur, RimLine with_line, const Parameters& p) {
  const RimCurve curve{p[0], p[1], p[2]};
  const double density = std::exp(p[3]), line = with_line == RimLine::some ? std::exp(p[4]) : 0;
  const double length = 2 * strip.half, inside_all = length * density * (strip.depth - curve.edge);
  Value value{-inside_all - length * line, {}, Information::Zero()};
  value.gradient << length * density, 0, 0, -inside_all, -length * line;
  int deep = 0;
  for (const Eigen::Vector2d& point : strip.points) {
    const double y = point.y() / strip.half, t = curve.insideOf(strip.half, point) / blur;
    if (t > whole) {
      ++deep;
      continue;
    }
    const double bell = std::exp(-t * t / 2) / std::sqrt(2 * std::numbers::pi) / blur;
    const double inside = density * std::erfc(-t / std::numbers::sqrt2) / 2, on_line = line * bell;
    const double sum = std::max(inside + on_line, smallest * density);
    value.logarithm += std::log(sum);
    const double by_edge = (on_line * t / blur - density * bell) / sum;
    Parameters part;
    part << by_edge, by_edge * y, by_edge * (y * y - 1. / 3), inside / sum, on_line / sum;
    value.gradient += part;
    value.information += part * part.transpose();
  }
  value.logarithm += deep * p[3];
  value.gradient[3] += deep;
  value.information(3, 3) += deep;
  return value;
}

}  // namespace

RimProfile fitRimProfile(const RimStrip& strip, double blur, RimLine line, const RimProfile& start) {
  Parameters at, way;
  at << start.curve.edge, start.curve.tilt, start.curve.bend, std::log(start.density), std::log(start.line);
  way << strip.depth, strip.half, strip.half, 1, 4;
  const Parameters least = at - way, most = at + way;
  Value value = likelihoodOf(strip, blur, line, at);
  double damping = first_damping;
  for (int step = 0; step < most_steps && damping < most_damping; ++step) {
    Information damped = value.information;
    damped.diagonal() *= 1 + damping;
    damped.diagonal().array() += 1e-9 * value.information.diagonal().maxCoeff();  // without a line it says nothing
    const Parameters next = (at + damped.ldlt().solve(value.gradient)).cwiseMax(least).cwiseMin(most);
    const Value next_value = likelihoodOf(strip, blur, line, next);
    if (!(next_value.logarithm > value.logarithm)) {
      damping *= 4;
      continue;
    }
    const double gain = next_value.logarithm - value.logarithm;
    at = next;
    value = next_value;
    damping = std::max(damping / 4, least_damping);
    if (gain < converged) break;
  }
  const double found_line = line == RimLine::some ? std::exp(at[4]) : 0;
  return {{at[0], at[1], at[2]}, std::exp(at[3]), found_line, value.logarithm};
}

}  // namespace tufted
