#include "denoise/listed_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "denoise/windows.h"
#include "shapes/shapes.h"
#include "support/ranked.h"

namespace tufted::listed_search_test {
namespace {

/// A cloud that can be searched, with windows of 32 or 64 neighbours and their radii.
struct SearchedCloud {
  RankedCloud ranked;
  NeighborSearch search;
  Windows windows;

  explicit SearchedCloud(const Points& points) : ranked(support::ranked(points)), search(ranked.points) {
    const auto n = static_cast<std::size_t>(ranked.size());
    windows.base.resize(n);
    windows.radius.resize(n);
    Buffer<Neighbor> neighbors;
    for (int p = 0; p < ranked.size(); ++p) {
      windows.base[p] = p / 100 % 2 == 0 ? 32 : 64;
      search.nearest(p, windows.base[p], neighbors);
      windows.radius[p] = std::sqrt(neighbors.back().squared_distance);
    }
  }
};

TEST(ListedSearch, FindsWhatSearchesForEachPointFind) {
  shapes::Cloud crowd = shapes::sphere(3000);
  crowd.points.topRows(2000) *= 1e-9;
  for (const auto& cloud : {shapes::sphere(3000), shapes::squareLattice(50), shapes::lidar({}), crowd}) {
    const SearchedCloud searched(cloud.points);
    const RankedCloud& ranked = searched.ranked;
    const Windows& windows = searched.windows;
    ListedSearch listed(ranked.points, searched.search);
    for (const int step : {1, 3, 40}) {  // all points, a third of them, points that are far apart
      Buffer<int> which;
      for (int p = 0; p < ranked.size(); p += p % 7 == 0 ? step : 1) which.push_back(p);
      std::size_t visited = 0;
      Buffer<Neighbor> expected;
      listed.forEach(
          which, [](int p) { return p; }, [&](int p) { return 2 * windows.base[p]; },
          [&](int p, std::span<const Neighbor> found) {
            ASSERT_EQ(p, which[visited++]);
            searched.search.nearest(p, 2 * windows.base[p], expected);
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

TEST(ListedSearch, OfMoreNeighborsThanThereAreFindsAll) {
  const SearchedCloud cloud(shapes::sphere(70).points);
  ListedSearch listed(cloud.ranked.points, cloud.search);
  const Buffer<int> which = {0, 1, 2, 69};
  listed.forEach(
      which, [](int p) { return p; }, [](int) { return 128; },
      [](int, std::span<const Neighbor> found) { EXPECT_EQ(found.size(), 69U); });
}

}  // namespace
}  // namespace tufted::listed_search_test
