#include "denoise/listed_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "shapes/shapes.h"
#include "support/ranked.h"

namespace tufted::listed_search_test {
namespace {

TEST(ListedSearch, FindsWhatSearchesForEachPointFind) {
  shapes::Cloud crowd = shapes::sphere(3000);
  crowd.points.topRows(2000) *= 1e-9;
  for (const auto& cloud : {shapes::sphere(3000), shapes::squareLattice(50), shapes::lidar({}), crowd}) {
    const RankedCloud ranked = support::ranked(cloud.points);
    const NeighborSearch search(ranked.points);
    for (const int step : {1, 3, 40}) {  // all points, a third of them, points that are far apart
      Buffer<int> which;
      for (int p = 0; p < ranked.size(); p += p % 7 == 0 ? step : 1) which.push_back(p);
      for (const int k : {3, 64, 256}) {
        std::size_t visited = 0;
        Buffer<Neighbor> expected;
        forEachListed(ranked.points, {}, search, which, k, [&](int p, std::span<const Neighbor> found) {
          ASSERT_EQ(p, which[visited++]);
          search.nearest(p, k, expected);
          const auto same = [](const Neighbor& a, const Neighbor& b) {
            return a.index == b.index && a.squared_distance == b.squared_distance;
          };
          ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end(), same))
              << cloud.name << ' ' << p;
        });
        EXPECT_EQ(visited, which.size());
      }
    }
  }
}

TEST(ListedSearch, OfMoreNeighborsThanThereAreFindsAll) {
  const RankedCloud cloud = support::ranked(shapes::sphere(70).points);
  const NeighborSearch search(cloud.points);
  const Buffer<int> which = {0, 1, 2, 69};
  forEachListed(cloud.points, {}, search, which, 128,
                [](int, std::span<const Neighbor> found) { EXPECT_EQ(found.size(), 69U); });
}

}  // namespace
}  // namespace tufted::listed_search_test
