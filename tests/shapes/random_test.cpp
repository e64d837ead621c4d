#include "shapes/random.h"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace tufted::shapes::random_test
