#include "neighbors/neighbors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "neighbors/batched_search.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/ranked.h"

namespace tufted::neighbors_test {
namespace {

TEST(Neighbors, EqualBruteForceWithTiesToTheSmallerIndex) {
  for (const auto& cloud : {shapes::sphere(1500), shapes::squareLattice(30), shapes::lidar({.azimuth_step = 4})}) {
    const RankedCloud ranked = support::ranked(cloud.points);
    const NeighborSearch search(ranked.points);
    Buffer<Neighbor> found, expected;
    for (int p = 0; p < ranked.size(); ++p) {
      const int k = p % 3 == 0 ? 100 : 30;  // kept in order, or sorted
      search.nearest(p, k, found);
      expected.clear();
      for (int q = 0; q < ranked.size(); ++q) {
        const Eigen::RowVector3d d = ranked.points.row(q) - ranked.points.row(p);
        if (q != p) expected.push_back({d.x() * d.x() + d.y() * d.y() + d.z() * d.z(), q});
      }
      std::sort(expected.begin(), expected.end());
      ASSERT_EQ(std::ssize(found), k);
      for (int j = 0; j < k; ++j) {
        ASSERT_EQ(found[j].index, expected[j].index) << cloud.name << " point " << p << " neighbour " << j;
        ASSERT_EQ(found[j].squared_distance, expected[j].squared_distance);
      }
    }
  }
}

/// Clouds with ties, lines, jumps between groups, an outlier, more points in a ball than a group may have, few points.
std::vector<shapes::Cloud> oddClouds() {
  shapes::Cloud crowd = shapes::sphere(3000);
  crowd.points.topRows(2000) *= 1e-9;
  crowd.points.row(2999) *= 1e12;
  return {shapes::sphere(5000), shapes::squareLattice(70), shapes::lidar({}), crowd, shapes::sphere(9)};
}

TEST(Neighbors, AreTheSameInAnyOrderAndWhateverWasSearchedBefore) {
  for (const auto& cloud : oddClouds()) {
    const RankedCloud ranked = support::ranked(cloud.points);
    const NeighborSearch search(ranked.points);
    Buffer<Neighbor> expected, found;
    SearchBefore before, unordered_before;
    for (int p = 0; p < ranked.size(); p += 1 + p % 7) {  // not always the next one
      const int k = 20 + p % 3 * 40;                      // sometimes more than the time before
      search.nearest(p, k, expected);
      search.nearest(p, k, found, NeighborOrder::ascending, &before);
      const auto same = [](const Neighbor& a, const Neighbor& b) {
        return a.index == b.index && a.squared_distance == b.squared_distance;
      };
      ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end(), same)) << cloud.name << p;
      search.nearest(p, k, found, NeighborOrder::any, &unordered_before);
      ASSERT_TRUE(same(found.back(), expected.back()));
      std::sort(found.begin(), found.end());
      ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end(), same)) << cloud.name << p;
    }
  }
}

TEST(Neighbors, AreTheSameInAnyNumberOfTrees) {
  const shapes::Cloud crowds = [] {
    shapes::Cloud cloud = shapes::sphere(40000);
    cloud.points.topRows(20000) = 1e-3 * cloud.points.topRows(20000).eval();
    return cloud;
  }();
  for (const auto& cloud : {crowds, shapes::squareLattice(200)}) {
    const RankedCloud ranked = support::ranked(cloud.points);
    const Progress silent;
    const Workers workers(3, silent);
    const NeighborSearch one(ranked.points), several(ranked.points, workers);
    EXPECT_NE(one.bytes(), several.bytes());  // there are several
    Buffer<Neighbor> expected, found;
    const auto expectSame = [&](int i) {
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t j = 0; j < found.size(); ++j) {
        ASSERT_EQ(found[j].index, expected[j].index) << cloud.name << ' ' << i << " neighbour " << j;
        ASSERT_EQ(found[j].squared_distance, expected[j].squared_distance);
      }
    };
    SearchBefore before;
    for (int p = 0; p < ranked.size(); p += 3) {
      one.nearest(p, 30, expected);
      several.nearest(p, 30, found, NeighborOrder::ascending, &before);
      expectSame(p);
    }
    BatchScratch scratch;
    nearestOfEach(one, ranked.points, 0, ranked.size(), 30, kernels(), scratch, expected);
    nearestOfEach(several, ranked.points, 0, ranked.size(), 30, kernels(), scratch, found);
    expectSame(-1);
    for (int p = 0; p < ranked.size(); p += 100) {
      const Eigen::RowVector3d position = 1.01 * ranked.points.row(p);
      one.nearestTo(position, expected);
      several.nearestTo(position, found);
      std::sort(expected.begin(), expected.end());
      std::sort(found.begin(), found.end());
      expectSame(p);
    }
  }
}

TEST(Neighbors, OfEachAreThoseOfOne) {
  for (const auto& cloud : oddClouds()) {
    const RankedCloud ranked = support::ranked(cloud.points);
    const NeighborSearch search(ranked.points);
    const int k = std::min(30, ranked.size() - 1);
    BatchScratch scratch;
    Buffer<Neighbor> each, one;
    for (const Kernels* kernel : {&portableKernels(), &kernels()}) {
      nearestOfEach(search, ranked.points, 0, ranked.size(), 30, *kernel, scratch, each);
      ASSERT_EQ(std::ssize(each), static_cast<std::ptrdiff_t>(ranked.size()) * k);
      for (int p = 0; p < ranked.size(); ++p) {
        search.nearest(p, 30, one);
        for (int j = 0; j < k; ++j) {
          ASSERT_EQ(each[p * k + j].index, one[j].index) << cloud.name << " point " << p << " neighbour " << j;
          ASSERT_EQ(each[p * k + j].squared_distance, one[j].squared_distance);
        }
      }
    }
  }
}

TEST(Neighbors, OfKnownCandidatesAreThoseOfTheTree) {
  double even = 0;  // how often there are twice as many on the sphere
  for (const auto& cloud : oddClouds()) {
    const RankedCloud ranked = support::ranked(cloud.points);
    const NeighborSearch search(ranked.points);
    BatchScratch scratch;
    Buffer<Neighbor> each, known, expected;
    EXPECT_FALSE(
        nearestOfKnown(search, ranked.points, 0, 1, 1, kernels(), scratch, known));  // nothing was asked before
    int found = 0, asked = 0;
    constexpr int block = 500;
    for (int first = 0; first < ranked.size(); first += block) {
      const int count = std::min(block, ranked.size() - first);
      nearestOfEach(search, ranked.points, first, count, 30, kernels(), scratch, each);
      EXPECT_FALSE(nearestOfKnown(search, ranked.points, first - 1, 1, 1, kernels(), scratch, known));
      EXPECT_FALSE(nearestOfKnown(search, ranked.points, first + count, 1, 1, kernels(), scratch, known));
      for (int i = count - 1; i >= 0; --i) {  // not in the order of the search
        const int k = std::min((i % 2 + 1) * 60, ranked.size() - 1);
        const double likely = i % 3 == 0 ? 0 : each[i * std::min(30, ranked.size() - 1)].squared_distance * 100;
        const bool is_found = nearestOfKnown(search, ranked.points, first + i, k, likely, kernels(), scratch, known);
        asked += k == 60 ? 1 : 0;
        if (!is_found) continue;
        found += k == 60 ? 1 : 0;
        search.nearest(first + i, k, expected);
        ASSERT_EQ(known.size(), expected.size());
        for (int j = 0; j < k; ++j) {
          ASSERT_EQ(known[j].index, expected[j].index) << cloud.name << " point " << first + i << " neighbour " << j;
          ASSERT_EQ(known[j].squared_distance, expected[j].squared_distance);
        }
      }
    }
    if (ranked.size() == 5000) even = static_cast<double>(found) / asked;
  }
  EXPECT_GT(even, 0.9);
}

TEST(Neighbors, OfKnownCandidatesOutliveASearchThatFailed) {
  // A lattice, then points of two crowds in turn: around any two of them there are more than a group may have.
  const Points lattice = shapes::squareLattice(16, 1).points;
  shapes::Random random(2);
  Points points(lattice.rows() + 2200, 3);
  points.topRows(lattice.rows()) = lattice;
  for (Eigen::Index i = lattice.rows(); i < points.rows(); ++i)
    points.row(i) << 1000 + double(i % 2) + 1e-3 * random.uniform(), 1e-3 * random.uniform(), 1e-3 * random.uniform();
  const NeighborSearch search(points);
  BatchScratch scratch;
  Buffer<Neighbor> each, known, expected;
  const int n = static_cast<int>(lattice.rows());
  nearestOfEach(search, points, 0, n + 32, 8, kernels(), scratch, each);
  ASSERT_LT(scratch.batches.back().first, n);
  int found = 0;
  for (int p = n - 1; p >= 0; --p) {
    if (!nearestOfKnown(search, points, p, 12, 1e9, kernels(), scratch, known)) continue;
    ++found;
    search.nearest(p, 12, expected);
    for (int j = 0; j < 12; ++j) ASSERT_EQ(known[j].index, expected[j].index) << p << " neighbour " << j;
  }
  EXPECT_GT(found, n / 2);
}

TEST(Neighbors, AreAllOthersWhenThereAreFewer) {
  Points points(3, 3);
  points << 0, 0, 0, 1, 0, 0, 0, 3, 0;
  const NeighborSearch search(points);
  Buffer<Neighbor> found;
  search.nearest(0, 30, found);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].index, 1);
  EXPECT_EQ(found[1].squared_distance, 9);
}

}  // namespace
}  // namespace tufted::neighbors_test
