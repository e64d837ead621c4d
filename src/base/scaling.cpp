#include "base/scaling.h"

#include <algorithm>
#include <cmath>

#include "base/buffer.h"

namespace tufted {
namespace {

constexpr double farthest_spreads = 1e70;   // in median spreads; squares and fourth powers of it still fit a double
constexpr double largest_distance = 1e152;  // in the caller's unit; an area still fits a double

double median(Buffer<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Scaling measureScaling(const Points& points, std::vector<PointStatus>& status) {
  const Eigen::Index n = points.rows();
  status.assign(static_cast<std::size_t>(n), PointStatus::active);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!points.row(i).allFinite()) status[i] = PointStatus::not_finite;
  }

  Scaling scaling;
  Buffer<double> values;
  values.reserve(static_cast<std::size_t>(n));
  for (int axis = 0; axis < 3; ++axis) {
    values.clear();
    for (Eigen::Index i = 0; i < n; ++i) {
      if (status[i] == PointStatus::active) values.push_back(points(i, axis));
    }
    scaling.center[axis] = median(values);
  }

  const auto deviation = [&](Eigen::Index i) {
    return (points.row(i) - scaling.center.transpose()).cwiseAbs().maxCoeff();
  };
  values.clear();
  for (Eigen::Index i = 0; i < n; ++i) {
    // Points at the centre itself say nothing about the spread; many copies of one point must not make it 0.
    if (status[i] == PointStatus::active && deviation(i) > 0) values.push_back(deviation(i));
  }
  const double spread = median(values);
  if (spread > 0 && std::isfinite(spread)) std::frexp(spread, &scaling.exponent);
  const PowerOfTwo to_spreads(-scaling.exponent);
  double largest = 0;  // coordinate of a usable point
  for (Eigen::Index i = 0; i < n; ++i) {
    if (status[i] != PointStatus::active) continue;
    // Relative to 2^exponent, so that the bound itself cannot overflow.
    const double distance = deviation(i);
    if (to_spreads.times(distance) <= farthest_spreads && distance <= largest_distance) {
      largest = std::max(largest, points.row(i).cwiseAbs().maxCoeff());
    } else {
      status[i] = PointStatus::not_finite;
    }
  }
  // A tiny cloud very far away: its scaled coordinates must stay finite.
  if (largest > 0) scaling.exponent = std::max(scaling.exponent, std::ilogb(largest) - 1000);
  return scaling;
}

}  // namespace tufted
