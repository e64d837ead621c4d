#pragma once

#include <algorithm>
#include <cmath>

namespace tufted {

/// Share of the smaller cotangent by which the sum of two at an edge may miss 0. The weight is then within 5e-10 of a
/// diagonal, half of what counts as rounding there.
constexpr double cotan_tolerance = 5e-10;

/// Whether the sum of two cotangents is further below 0 than `tolerance` and rounding, which grows with them.
template <class Real>
bool isBelowRounding(Real here, Real there, double tolerance, double share = cotan_tolerance) {
  return here + there < -tolerance - share * std::min(std::abs(here), std::abs(there));
}

}  // namespace tufted
