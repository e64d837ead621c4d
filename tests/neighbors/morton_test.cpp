#include "neighbors/morton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "shapes/shapes.h"
#include "support/ranked.h"

namespace tufted::morton_test {
namespace {

RankedCloud rankOn(int threads, const Points& points, std::vector<PointStatus>& status,
                   std::vector<int>& representative) {
  const Progress silent;
  return rankPoints(points, status, representative, Workers(threads, silent));
}

/// (x, y, z) < 64 each, x in the lowest of every three bits.
int interleaved(const Eigen::RowVector3d& point) {
  int code = 0;
  for (int bit = 0; bit < 6; ++bit)
    for (int axis = 0; axis < 3; ++axis) code |= (static_cast<int>(point[axis]) >> bit & 1) << (3 * bit + axis);
  return code;
}

TEST(Rank, OnALatticeIsItsInterleavedCoordinates) {
  constexpr int side = 64;
  shapes::Cloud lattice;
  lattice.points.resize(side * side * side, 3);
  for (int i = 0; i < lattice.points.rows(); ++i) lattice.points.row(i) << i % side, i / side % side, i / (side * side);
  lattice.normals = lattice.points;
  const Points points = shapes::shuffled(lattice).points;
  for (const int threads : {1, 3}) {
    std::vector<PointStatus> status;
    std::vector<int> representative;
    const RankedCloud cloud = rankOn(threads, points, status, representative);
    ASSERT_EQ(cloud.size(), points.rows());
    for (int rank = 0; rank < cloud.size(); ++rank)
      ASSERT_EQ(interleaved(points.row(cloud.input_index[rank])), rank) << threads << " threads";
  }
}

TEST(Rank, OfCrowdsAndCopiesIsTheSameOnAnyNumberOfThreads) {
  // A third of the points share the leading bits of their codes, another third stands on one spot each with a copy.
  constexpr int n = 300'000;
  Points points = shapes::sphere(n).points;
  points.middleRows(n / 3, n / 3) *= 1e-9;
  points.bottomRows(n / 3) = points.topRows(n / 3);
  std::vector<PointStatus> status, status_again;
  std::vector<int> representative, representative_again;
  const RankedCloud cloud = rankOn(1, points, status, representative);
  ASSERT_EQ(cloud.size(), n - n / 3);
  for (int i = 0; i < n; ++i) {
    const bool is_copy = i >= n - n / 3;
    ASSERT_EQ(status[i], is_copy ? PointStatus::coincident : PointStatus::active) << i;
    ASSERT_EQ(representative[i], is_copy ? i - (n - n / 3) : i);
  }
  for (const int threads : {2, 5}) {
    const RankedCloud again = rankOn(threads, points, status_again, representative_again);
    EXPECT_EQ(again.input_index, cloud.input_index);
    EXPECT_EQ(again.points.all(), cloud.points.all());
    EXPECT_EQ(status_again, status);
    EXPECT_EQ(representative_again, representative);
  }
}

TEST(Rank, DoesNotDependOnTheCallersOrder) {
  const auto lattice = shapes::squareLattice(40);
  const RankedCloud a = support::ranked(lattice.points), b = support::ranked(shapes::shuffled(lattice).points);
  EXPECT_EQ(a.points.all(), b.points.all());
}

TEST(Rank, NamesTheLowestIndexOfCoincidentPoints) {
  Points points(5, 3);
  points << 1, 2, 3, 0, 0, 0, 1, 2, 3, -0.0, 0, 0, 1, 2, 3;
  std::vector<PointStatus> status;
  std::vector<int> representative;
  EXPECT_EQ(rankPoints(points, status, representative).size(), 2);
  EXPECT_EQ(representative, (std::vector<int>{0, 1, 0, 1, 0}));
}

}  // namespace
}  // namespace tufted::morton_test
