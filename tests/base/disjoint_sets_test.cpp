#include "base/disjoint_sets.h"

#include <gtest/gtest.h>

#include <vector>

#include "shapes/random.h"

namespace tufted::disjoint_sets_test {
namespace {

TEST(DisjointSets, HaveTheirSmallestElementAsRootInAnyOrderOfUnions) {
  // i and i + 7 are joined: the sets are the remainders modulo 7.
  constexpr int size = 1000, sets = 7;
  for (const std::uint64_t seed : {1, 2, 3}) {
    DisjointSets disjoint(size);
    int joined = 0;
    for (const int i : shapes::Random(seed).permutation(size - sets)) joined += disjoint.unite(i + sets, i) ? 1 : 0;
    EXPECT_EQ(joined, size - sets);
    for (int i = 0; i < size; ++i) EXPECT_EQ(disjoint.root(i), i % sets);
    EXPECT_FALSE(disjoint.unite(3, 3 + 5 * sets));
  }
}

}  // namespace
}  // namespace tufted::disjoint_sets_test
