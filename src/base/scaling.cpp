#include "base/scaling.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/buffer.h"
#include "base/infinity.h"

namespace tufted {
namespace {

/// Points farther than this, in median spreads, count as not finite: squares and fourth powers of scaled coordinates
/// must fit a double.
constexpr double farthest_spreads = 1e70;
/// Largest distance in the caller's unit: an area, its square, must fit a double.
constexpr double largest_distance = 1e152;

/// Number of sampled values, whose median is near that of all; one pass then leaves a tenth of all values to choose
/// from.
constexpr std::int64_t sampled_values = 2048;
/// The median of all is searched between the samples this many places before and after their median, four standard
/// deviations of its place; if it is not there, all values are searched.
constexpr std::ptrdiff_t places_beside = 100;
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

struct Extent {
  double largest = 0;  ///< largest |coordinate|
  Eigen::Array3d lowest = Eigen::Array3d::Constant(infinity);

  void widen(const Eigen::Array3d& point) {
    largest = std::max(largest, point.abs().maxCoeff());
    lowest = lowest.min(point);
  }
  void widen(const Extent& other) {
    largest = std::max(largest, other.largest);
    lowest = lowest.min(other.lowest);
  }
};

/// The values within two bounds, and the number of values below and above them.
struct Within {
  Buffer<double> values;
  std::size_t below = 0, above = 0;
};

template <class ValueOf>
Within valuesWithin(double least, double most, std::int64_t n, const ValueOf& valueOf, const Workers& workers) {
  Buffer<Within> blocks(static_cast<std::size_t>((n + cheapest_block - 1) / cheapest_block));
  workers.forBlocks("scale", n, cheapest_block, [&](std::int64_t begin, std::int64_t end, int) {
    Within here;
    for (std::int64_t i = begin; i < end; ++i) {
      const double value = valueOf(i);
      here.below += value < least ? 1 : 0;
      here.above += value > most ? 1 : 0;
      if (value >= least && value <= most) here.values.push_back(value);
    }
    blocks[begin / cheapest_block] = std::move(here);
  });
  Within all;
  std::size_t count = 0;
  for (const Within& block : blocks) count += block.values.size();
  all.values.reserve(count);
  for (const Within& block : blocks) {
    all.values.insert(all.values.end(), block.values.begin(), block.values.end());
    all.below += block.below;
    all.above += block.above;
  }
  return all;
}

/// The median of n values valueOf(i), without those that are NaN. Of an even number it is the upper one of the two in
/// the middle, and of no values it is 0.
template <class ValueOf>
double medianOfAll(std::int64_t n, const ValueOf& valueOf, const Workers& workers) {
  Buffer<double> some;
  for (std::int64_t i = 0; i < n; i += std::max<std::int64_t>(1, n / sampled_values))
    if (const double value = valueOf(i); !std::isnan(value)) some.push_back(value);
  std::sort(some.begin(), some.end());
  const auto middle = some.begin() + std::ssize(some) / 2;
  const bool has_bounds = std::ssize(some) > 2 * places_beside + 1;
  Within found = valuesWithin(has_bounds ? middle[-places_beside] : -infinity,
                              has_bounds ? middle[places_beside] : infinity, n, valueOf, workers);
  const std::size_t rank = (found.below + found.values.size() + found.above) / 2;
  // The samples misjudged the bounds, so all values are searched.
  if (rank < found.below || rank >= found.below + found.values.size())
    found = valuesWithin(-infinity, infinity, n, valueOf, workers);
  if (found.values.empty()) return 0;
  const auto at = found.values.begin() + static_cast<std::ptrdiff_t>(rank - found.below);
  std::nth_element(found.values.begin(), at, found.values.end());
  return *at;
}

}  // namespace

bool isWithinReach(const Scaling& scaling, double deviation) {
  // Relative to 2^exponent, so that the bound itself cannot overflow.
  return scaling.toScaled().times(deviation) <= farthest_spreads && deviation <= largest_distance;
}

void widenUnit(Scaling& scaling, double largest) {
  if (largest > 0) scaling.exponent = std::max(scaling.exponent, std::ilogb(largest) - 1000);
}

Scaling measureScaling(const PointsRef& points, std::vector<PointStatus>& status, const Workers& workers) {
  const Eigen::Index n = points.rows();
  status.resize(static_cast<std::size_t>(n));
  const auto forBlocks = [&](const auto& work) { workers.forBlocks("scale", n, cheapest_block, work); };
  forBlocks([&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i)
      status[i] = points.row(i).allFinite() ? PointStatus::active : PointStatus::not_finite;
  });

  Scaling scaling;
  const auto isUsable = [&](std::int64_t i) { return status[i] == PointStatus::active; };
  for (int axis = 0; axis < 3; ++axis)
    scaling.center[axis] = medianOfAll(
        n, [&](std::int64_t i) { return isUsable(i) ? points(i, axis) : no_value; }, workers);

  const auto deviation = [&](Eigen::Index i) {
    return (points.row(i) - scaling.center.transpose()).cwiseAbs().maxCoeff();
  };
  // Points at the centre are left out of the spread, so that many copies of one point do not make it 0.
  const auto deviationOfOther = [&](std::int64_t i) {
    const double distance = isUsable(i) ? deviation(i) : 0;
    return distance > 0 ? distance : no_value;
  };
  const double spread = medianOfAll(n, deviationOfOther, workers);
  if (spread > 0 && std::isfinite(spread)) std::frexp(spread, &scaling.exponent);
  Buffer<Extent> extent_of(workers.count());
  forBlocks([&](std::int64_t begin, std::int64_t end, int worker) {
    Extent here;  // local, because workers would share a cache line in extent_of
    for (std::int64_t i = begin; i < end; ++i) {
      if (!isUsable(i)) continue;
      if (isWithinReach(scaling, deviation(i)))
        here.widen(points.row(i).transpose());
      else
        status[i] = PointStatus::not_finite;
    }
    extent_of[worker].widen(here);
  });
  Extent extent;
  for (const Extent& part : extent_of) extent.widen(part);
  scaling.lowest = extent.lowest;
  widenUnit(scaling, extent.largest);
  return scaling;
}

}  // namespace tufted
