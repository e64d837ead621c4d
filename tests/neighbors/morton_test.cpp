#include "neighbors/morton.h"

#include <gtest/gtest.h>

#include <vector>

#include "shapes/shapes.h"

namespace tufted::morton_test {
namespace {

RankedCloud rankOn(int threads, const Points& points, std::vector<PointStatus>& status,
                   std::vector<int>& representative) {
  const Progress silent;
  return rankPoints(points, status, representative, Workers(threads, silent));
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

}  // namespace
}  // namespace tufted::morton_test
