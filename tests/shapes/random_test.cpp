#include "shapes/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tufted::shapes::random_test {
namespace {

TEST(Random, UniformIsTheEnginesTop53Bits) {
  // The standard fixes the 10000th output of the default-seeded engine.
  std::mt19937_64 engine;
  engine.discard(9999);
  ASSERT_EQ(engine(), 9981545732273789042ull);
  Random random(std::mt19937_64::default_seed);
  for (int i = 0; i < 9999; ++i) random.uniform();
  EXPECT_EQ(random.uniform(), std::ldexp(static_cast<double>(9981545732273789042ull >> 11), -53));
}

TEST(Random, NormalHasTheMomentsOfTheNormalDistribution) {
  Random random(7);
  constexpr int n = 200000;
  double sum[5] = {};
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    for (int k = 1; k <= 4; ++k) sum[k] += std::pow(x, k) / n;
  }
  EXPECT_NEAR(sum[1], 0, 0.01);
  EXPECT_NEAR(sum[2], 1, 0.02);
  EXPECT_NEAR(sum[3], 0, 0.05);
  EXPECT_NEAR(sum[4], 3, 0.1);
}

TEST(Random, PermutationHoldsEveryIndexOnce) {
  std::vector<int> order = Random(3).permutation(1000);
  EXPECT_FALSE(std::is_sorted(order.begin(), order.end()));
  std::sort(order.begin(), order.end());
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(order[i], i);
}

}  // namespace
}  // namespace tufted::shapes::random_test
