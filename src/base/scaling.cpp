#include "base/scaling.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "base/buffer.h"

namespace tufted {
namespace {

constexpr double farthest_spreads = 1e70;   // in median spreads; squares and fourth powers of it still fit a double
constexpr double largest_distance = 1e152;  // in the caller's unit; an area still fits a double

constexpr std::size_t few = 1 << 15;  // values, of which one is chosen as fast without counting

/// Grows with x.
std::uint64_t ordinalOf(double x) {
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  return (bits & sign) != 0 ? ~bits : bits | sign;
}

/// The value that `rank` others come before. Overwrites the values.
double select(RawBuffer<double>& values, std::size_t rank) {
  // By the leading bits first, which takes two passes and leaves few.
  auto last = values.end();
  if (values.size() > few) {
    constexpr int bits = 16;
    const auto leading = [](double x) { return ordinalOf(x) >> (64 - bits); };
    Buffer<std::uint32_t> count(std::size_t{1} << bits);
    for (const double x : values) ++count[leading(x)];
    std::uint64_t chosen = 0;
    for (; rank >= count[chosen]; ++chosen) rank -= count[chosen];
    last = std::remove_if(values.begin(), values.end(), [&](double x) { return leading(x) != chosen; });
  }
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), place, last);
  return *place;
}

}  // namespace

Scaling measureScaling(const PointsRef& points, std::vector<PointStatus>& status, const Workers& workers) {
  const Eigen::Index n = points.rows();
  status.resize(static_cast<std::size_t>(n));
  const auto forAll = [&](const auto& visit) {
    workers.forBlocks("scale", n, cheapest_block, [&](std::int64_t begin, std::int64_t end, int worker) {
      for (std::int64_t i = begin; i < end; ++i) visit(i, worker);
    });
  };
  Buffer<std::size_t> usable_of(workers.count());
  forAll([&](std::int64_t i, int worker) {
    const bool is_finite = points.row(i).allFinite();
    status[i] = is_finite ? PointStatus::active : PointStatus::not_finite;
    usable_of[worker] += is_finite ? 1 : 0;
  });
  const std::size_t usable = std::accumulate(usable_of.begin(), usable_of.end(), std::size_t{0});
  Scaling scaling;
  if (usable == 0) return scaling;

  workers.forBlocks("scale", 3, 1, [&](std::int64_t axis, std::int64_t, int) {
    RawBuffer<double> values;
    values.reserve(usable);
    for (Eigen::Index i = 0; i < n; ++i)
      if (status[i] == PointStatus::active) values.push_back(points(i, axis));
    scaling.center[axis] = select(values, usable / 2);
  });

  const auto deviation = [&](Eigen::Index i) {
    return (points.row(i) - scaling.center.transpose()).cwiseAbs().maxCoeff();
  };
  RawBuffer<double> values(static_cast<std::size_t>(n));
  forAll([&](std::int64_t i, int) { values[i] = status[i] == PointStatus::active ? deviation(i) : 0; });
  // Points at the centre itself say nothing about the spread; many copies of one point must not make it 0.
  const auto zeros = static_cast<std::size_t>(std::count(values.begin(), values.end(), 0.0));
  const double spread = zeros < values.size() ? select(values, zeros + (values.size() - zeros) / 2) : 0;
  if (spread > 0 && std::isfinite(spread)) std::frexp(spread, &scaling.exponent);
  const PowerOfTwo to_spreads(-scaling.exponent);
  Buffer<double> largest_of(workers.count());  // coordinate of a usable point
  forAll([&](std::int64_t i, int worker) {
    if (status[i] != PointStatus::active) return;
    // Relative to 2^exponent, so that the bound itself cannot overflow.
    const double distance = deviation(i);
    if (to_spreads.times(distance) <= farthest_spreads && distance <= largest_distance) {
      largest_of[worker] = std::max(largest_of[worker], points.row(i).cwiseAbs().maxCoeff());
    } else {
      status[i] = PointStatus::not_finite;
    }
  });
  const double largest = *std::max_element(largest_of.begin(), largest_of.end());
  // A tiny cloud very far away: its scaled coordinates must stay finite.
  if (largest > 0) scaling.exponent = std::max(scaling.exponent, std::ilogb(largest) - 1000);
  return scaling;
}

}  // namespace tufted
