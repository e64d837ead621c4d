#include "neighbors/morton.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>

#include "base/buffer.h"
#include "base/scaling.h"

namespace tufted {
namespace {

constexpr int axis_bits = MortonGrid::axis_bits;
constexpr double axis_cells = 1 << axis_bits;
constexpr double cells = 1 << MortonGrid::spread_bits;  // per median spread

/// Spreads the low 21 bits of v to every third bit.
std::uint64_t spreadBits(std::uint64_t v) {
  v = (v | v << 32) & 0x001f00000000ffffULL;
  v = (v | v << 16) & 0x001f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2) & 0x1249249249249249ULL;
}

std::uint64_t mortonCode(const Eigen::Array3d& from_corner) {
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = from_corner[axis] * cells;
    const double clamped = std::clamp(cell, 0.0, axis_cells - 1);  // outliers fall into the cells of the border
    code |= spreadBits(static_cast<std::uint64_t>(clamped)) << axis;
  }
  return code;
}

struct Key {
  std::uint64_t code;
  int index;
};

/// Bits of a digit of the radix sort: four passes, whose counters fit the first-level cache.
constexpr int digit_bits = 11;
constexpr std::size_t buckets = std::size_t{1} << digit_bits;
/// The lowest bit that the radix sort uses. Lower bits distinguish so few points that two more passes would cost more
/// than comparisons.
constexpr int lowest_bit = 22;
constexpr std::int64_t least_keys_per_thread = 1 << 16;

/// Stable parallel radix sort of the keys by the bits of their codes from lowest_bit on, least significant digit first.
void sortByHighBits(RawBuffer<Key>& keys, const Workers& workers) {
  const std::int64_t size = std::ssize(keys);
  const std::int64_t part = std::max(least_keys_per_thread, (size + workers.count() - 1) / workers.count());
  const std::int64_t parts = (size + part - 1) / part;
  RawBuffer<Key> sorted(keys.size());
  Buffer<std::array<std::uint32_t, buckets>> place(static_cast<std::size_t>(parts));
  for (int bit = lowest_bit; bit < 3 * axis_bits; bit += digit_bits) {
    const auto digitOf = [bit](const Key& key) { return key.code >> bit & (buckets - 1); };
    workers.forBlocks("order", size, part, [&](std::int64_t begin, std::int64_t end, int) {
      std::array<std::uint32_t, buckets>& count = place[begin / part];
      count.fill(0);
      for (std::int64_t i = begin; i < end; ++i) ++count[digitOf(keys[i])];
    });
    std::uint32_t next = 0;
    for (std::size_t digit = 0; digit < buckets; ++digit)
      for (auto& count : place) next += std::exchange(count[digit], next);
    workers.forBlocks("order", size, part, [&](std::int64_t begin, std::int64_t end, int) {
      std::array<std::uint32_t, buckets>& to = place[begin / part];
      for (std::int64_t i = begin; i < end; ++i) sorted[to[digitOf(keys[i])]++] = keys[i];
    });
    keys.swap(sorted);
  }
}

/// Sorts keys that sortByHighBits() left equal, by comparison.
template <class Less>
void sortByRest(RawBuffer<Key>& keys, const Workers& workers, const Less& less) {
  const auto high = [&](std::int64_t i) { return keys[i].code >> lowest_bit; };
  const std::int64_t size = std::ssize(keys);
  Buffer<std::int64_t> start;  // starts of parts that consist of whole runs
  for (std::int64_t i = 0; i < size; i += least_keys_per_thread) {
    while (i > 0 && i < size && high(i) == high(i - 1)) ++i;
    start.push_back(i);
  }
  start.push_back(size);
  workers.forBlocks("order", std::ssize(start) - 1, 1, [&](std::int64_t part, std::int64_t, int) {
    for (std::int64_t first = start[part]; first < start[part + 1];) {
      std::int64_t last = first + 1;
      while (last < start[part + 1] && high(last) == high(first)) ++last;
      if (last - first > 1) std::sort(keys.begin() + first, keys.begin() + last, less);
      first = last;
    }
  });
}

/// Removes points that equal the previous one, which becomes their representative.
void mergeCoincident(RankedCloud& cloud, std::vector<PointStatus>& status, std::vector<int>& representative,
                     const Workers& workers) {
  const Buffer<int> repeated = numbersWhere("order", cloud.size(), workers, [&](int rank) {
    return rank > 0 && cloud.points.row(rank) == cloud.points.row(rank - 1);
  });
  if (repeated.empty()) return;
  auto next = repeated.begin();
  int kept = *next;
  for (int rank = kept; rank < cloud.size(); ++rank) {
    if (next != repeated.end() && rank == *next) {
      ++next;
      status[cloud.input_index[rank]] = PointStatus::coincident;
      representative[cloud.input_index[rank]] = cloud.input_index[kept - 1];
    } else {
      cloud.points.row(kept) = cloud.points.row(rank);
      cloud.input_index[kept++] = cloud.input_index[rank];
    }
  }
  cloud.points.resize(kept);
  cloud.input_index.resize(static_cast<std::size_t>(kept));
}

}  // namespace

MortonGrid::MortonGrid(const Scaling& scaling) : to_scaled_(scaling.toScaled()) {
  // The grid starts at the least corner of the data, but at most 16 spreads from the centre.
  for (int axis = 0; axis < 3; ++axis)
    corner_[axis] = std::max(to_scaled_.times(scaling.center[axis]) - 16, to_scaled_.times(scaling.lowest[axis]));
}

Eigen::Array3d MortonGrid::scaled(const Eigen::RowVector3d& point) const {
  const auto times = [&](double x) { return to_scaled_.times(x) + 0.0; };
  return {times(point.x()), times(point.y()), times(point.z())};
}

std::uint64_t MortonGrid::codeOf(const Eigen::Array3d& scaled) const {
  return mortonCode(scaled - corner_);
}

RankedCloud rankPoints(const PointsRef& points, std::vector<PointStatus>& status, std::vector<int>& representative) {
  const Progress silent;
  return rankPoints(points, status, representative, Workers(1, silent));
}

RankedCloud rankPoints(const PointsRef& points, std::vector<PointStatus>& status, std::vector<int>& representative,
                       const Workers& workers, const Scaling* whole) {
  RankedCloud cloud;
  if (whole != nullptr) status.assign(static_cast<std::size_t>(points.rows()), PointStatus::active);
  const Scaling scaling = whole != nullptr ? *whole : measureScaling(points, status, workers);
  cloud.exponent = scaling.exponent;
  representative.resize(static_cast<std::size_t>(points.rows()));
  std::iota(representative.begin(), representative.end(), 0);
  cloud.input_index = numbersWhere("order", static_cast<int>(points.rows()), workers,
                                   [&](int i) { return status[i] != PointStatus::not_finite; });
  const std::int64_t size = std::ssize(cloud.input_index);
  const auto forAll = [&](const auto& visit) {
    workers.forBlocks("order", size, usual_block, [&](std::int64_t begin, std::int64_t end, int) {
      for (std::int64_t i = begin; i < end; ++i) visit(i);
    });
  };

  const MortonGrid grid(scaling);
  const auto scaled = [&](int i) { return grid.scaled(points.row(i)); };
  RawBuffer<Key> keys(cloud.input_index.size());
  forAll([&](std::int64_t i) {
    const int index = cloud.input_index[i];
    keys[i] = {grid.codeOf(scaled(index)), index};
  });
  // No two keys are equal, so the order does not depend on how they are sorted.
  sortByHighBits(keys, workers);
  sortByRest(keys, workers, [&](const Key& a, const Key& b) {
    if (a.code != b.code) return a.code < b.code;
    const Eigen::Array3d a_point = scaled(a.index), b_point = scaled(b.index);
    for (int axis = 0; axis < 3; ++axis) {
      if (a_point[axis] != b_point[axis]) return a_point[axis] < b_point[axis];
    }
    return a.index < b.index;
  });
  cloud.points.resize(size);
  forAll([&](std::int64_t rank) {
    cloud.input_index[rank] = keys[rank].index;
    cloud.points.row(rank) = scaled(keys[rank].index).matrix().transpose();
  });
  mergeCoincident(cloud, status, representative, workers);
  return cloud;
}

}  // namespace tufted
