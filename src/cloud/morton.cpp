#include "cloud/morton.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <parallel/algorithm>

#include "base/buffer.h"
#include "base/scaling.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 4096;
constexpr int serial_sort = 2;  // threads up to which sorting by comparison on all of them takes longer
constexpr double axis_cells = 1 << 21;
constexpr double cells = 1 << 16;  // per median spread; so 2^21 cells reach over 32 spreads

/// Spreads the low 21 bits of v to every third bit.
std::uint64_t spreadBits(std::uint64_t v) {
  v = (v | v << 32) & 0x001f00000000ffffULL;
  v = (v | v << 16) & 0x001f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2) & 0x1249249249249249ULL;
}

std::uint64_t mortonCode(const Eigen::Vector3d& from_corner) {
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = from_corner[axis] * cells;
    const double clamped = std::clamp(cell, 0.0, axis_cells - 1);  // outliers go to the border
    code |= spreadBits(static_cast<std::uint64_t>(clamped)) << axis;
  }
  return code;
}

struct Key {
  std::uint64_t code;
  int index;
};

/// Sorts by code, those of one code as they come, digit by digit from the last.
void sortByCode(Buffer<Key>& keys) {
  constexpr int digit_bits = 11, digits = 6;
  constexpr std::uint64_t mask = (1 << digit_bits) - 1;
  const auto digitOf = [](const Key& key, int d) { return key.code >> (d * digit_bits) & mask; };
  Buffer<std::uint32_t> count(digits << digit_bits);
  for (const Key& key : keys)
    for (int d = 0; d < digits; ++d) ++count[(d << digit_bits) + digitOf(key, d)];
  Buffer<Key> sorted(keys.size());
  for (int d = 0; d < digits; ++d) {
    std::uint32_t* const place = count.data() + (d << digit_bits);
    if (place[digitOf(keys.front(), d)] == keys.size()) continue;  // the same digit everywhere
    std::exclusive_scan(place, place + mask + 1, place, std::uint32_t{0});
    for (const Key& key : keys) sorted[place[digitOf(key, d)]++] = key;
    keys.swap(sorted);
  }
}

}  // namespace

RankedCloud rankPoints(const Points& points, std::vector<PointStatus>& status, std::vector<int>& representative) {
  const Progress silent;
  return rankPoints(points, status, representative, Workers(1, silent));
}

RankedCloud rankPoints(const Points& points, std::vector<PointStatus>& status, std::vector<int>& representative,
                       const Workers& workers) {
  RankedCloud cloud;
  const Scaling scaling = measureScaling(points, status);
  cloud.exponent = scaling.exponent;
  representative.resize(static_cast<std::size_t>(points.rows()));
  std::iota(representative.begin(), representative.end(), 0);

  const PowerOfTwo to_scaled = scaling.toScaled();
  PointBuffer scaled(points.rows());
  Eigen::Vector3d lowest = Eigen::Vector3d::Constant(INFINITY);
  Buffer<Key> keys;
  keys.reserve(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (status[i] == PointStatus::not_finite) continue;
    for (int axis = 0; axis < 3; ++axis)
      scaled.row(i)[axis] = to_scaled.times(points(i, axis)) + 0.0;  // no -0: equal have equal bits
    lowest = lowest.cwiseMin(scaled.row(i).transpose());
    keys.push_back({0, static_cast<int>(i)});
  }
  // The grid starts at a corner of the data, but not further than 16 spreads from its middle.
  Eigen::Vector3d corner;
  for (int axis = 0; axis < 3; ++axis) {
    corner[axis] = std::max(lowest[axis], to_scaled.times(scaling.center[axis]) - 16);
  }
  workers.forBlocks("order", std::ssize(keys), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i)
      keys[i].code = mortonCode(scaled.row(keys[i].index).transpose() - corner);
  });

  const auto comesBefore = [&](const Key& a, const Key& b) {
    if (a.code != b.code) return a.code < b.code;
    const auto a_point = scaled.row(a.index), b_point = scaled.row(b.index);
    for (int axis = 0; axis < 3; ++axis) {
      if (a_point[axis] != b_point[axis]) return a_point[axis] < b_point[axis];
    }
    return a.index < b.index;
  };
  // Keys differ, so any way of sorting gives the same order.
  if (workers.count() > serial_sort && std::ssize(keys) > block_size) {
    const auto threads = static_cast<__gnu_parallel::_ThreadIndex>(workers.count());
    __gnu_parallel::sort(keys.begin(), keys.end(), comesBefore, __gnu_parallel::multiway_mergesort_tag(threads));
  } else if (!keys.empty()) {
    sortByCode(keys);
    for (auto first = keys.begin(); first != keys.end();) {
      const auto last = std::find_if(first + 1, keys.end(), [&](const Key& key) { return key.code != first->code; });
      if (last - first > 1) std::sort(first, last, comesBefore);
      first = last;
    }
  }

  cloud.caller.reserve(keys.size());
  for (const Key& key : keys) {
    if (!cloud.caller.empty() && scaled.row(key.index) == scaled.row(cloud.caller.back())) {
      status[key.index] = PointStatus::coincident;
      representative[key.index] = cloud.caller.back();
    } else {
      cloud.caller.push_back(key.index);
    }
  }
  cloud.points.resize(cloud.size());
  workers.forBlocks("order", cloud.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t rank = begin; rank < end; ++rank) cloud.points.row(rank) = scaled.row(cloud.caller[rank]);
  });
  return cloud;
}

}  // namespace tufted
