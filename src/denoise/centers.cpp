#include "denoise/centers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "denoise/listed_search.h"

namespace tufted {
namespace {

/// One point in this many is a centre of the first look, which takes 0.55 us per point of an exact sphere, a fifth of a
/// clean build.
constexpr std::uint64_t first_look_stride = 32;
/// A centre comes before this many of its nearest points. With 1, 2, 3 and 4 real shapes with noise of 0.3 spacings
/// keep 0.157, 0.159, 0.161 and 0.164 of it.
constexpr std::size_t behind = 2;
/// Where normals are given, these are found among this many, as others may be on the other side of a thin part.
constexpr int among_sides = 16;

/// A hash of the coordinates of p that does not change if they are scaled by a power of two.
std::uint64_t hashOf(const PointsView& points, int p) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    int exponent = 0;
    hash ^= std::bit_cast<std::uint64_t>(std::frexp(points(p, axis), &exponent));
    // The multiplier of SplitMix64, and a shift that mixes high bits into low ones.
    hash *= 0xbf58476d1ce4e5b9U;
    hash ^= hash >> 31;
  }
  return hash;
}

}  // namespace

PointBuffer placesOf(const PointsView& points, std::span<const int> ranks) {
  PointBuffer places(std::ssize(ranks));
  for (Eigen::Index i = 0; i < places.rows(); ++i) places.row(i) = points.row(ranks[i]);
  return places;
}

Centers fewCenters(const PointsView& points, const Workers& workers) {
  const auto n = static_cast<int>(points.rows());
  Centers centers;
  centers.rank = numbersWhere("noise", n, workers, [&](int p) { return hashOf(points, p) % first_look_stride == 0; });
  if (centers.rank.empty()) return centers;
  const PointBuffer places = placesOf(points, centers.rank);
  const NeighborSearch search(places, workers);
  centers.near.resize(static_cast<std::size_t>(n));
  workers.forBlocks("noise", n, star_block, [&](std::int64_t begin, std::int64_t end, int) {
    Buffer<Neighbor> found;
    for (auto p = static_cast<int>(begin); p < end; ++p) {
      search.nearestTo(points.row(p), found);
      centers.near[p] = std::min_element(found.begin(), found.end())->index;
    }
  });
  return centers;
}

Centers manyCenters(const PointsView& points, const PointBuffer& normals, const NeighborSearch& search,
                    const Buffer<std::uint8_t>& inside, const Workers& workers) {
  const auto n = static_cast<std::size_t>(points.rows());
  const Buffer<int> asked = numbersWhere("noise", static_cast<int>(n), workers, [&](int p) { return inside[p] != 0; });
  const int searched = normals.rows() > 0 ? among_sides : static_cast<int>(behind);
  RawBuffer<double> order(n);
  RawBuffer<std::array<int, behind>> nearest(n);
  workers.forBlocks("noise", std::ssize(asked), star_block, [&](std::int64_t begin, std::int64_t end, int) {
    forEachListed(points, normals, search, std::span(asked).subspan(begin, end - begin), searched,
                  [&](int p, std::span<const Neighbor> neighbors) {
                    const Neighbor& last = neighbors[std::min(behind, neighbors.size()) - 1];
                    order[p] = neighbors.front().squared_distance / last.squared_distance;
                    for (std::size_t i = 0; i < behind; ++i)
                      nearest[p][i] = i < neighbors.size() ? neighbors[i].index : last.index;
                  });
  });
  const auto isBefore = [&](int p, int q) {
    return order[p] != order[q] ? order[p] < order[q] : hashOf(points, p) < hashOf(points, q);
  };
  // The first point, in this order, of p and its nearest.
  const auto next = [&](int p) {
    int first = p;
    for (const int q : nearest[p])
      if (inside[q] != 0 && isBefore(q, first)) first = q;
    return first;
  };
  Centers centers;
  centers.near.resize(n);
  for (const int p : asked) {
    if (next(p) != p) continue;
    centers.near[p] = static_cast<int>(centers.rank.size());
    centers.rank.push_back(p);
  }
  workers.forBlocks("noise", std::ssize(asked), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i) {
      int center = asked[i];
      for (int q = next(center); q != center; q = next(q)) center = q;
      if (center != asked[i]) centers.near[asked[i]] = centers.near[center];
    }
  });
  return centers;
}

}  // namespace tufted
