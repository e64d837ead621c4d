#include "base/power_of_two.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tufted::power_of_two_test {
namespace {

TEST(PowerOfTwo, MultipliesLikeLdexpAtAnyScale) {
  for (int exponent = -2200; exponent <= 2200; exponent += 7) {
    const PowerOfTwo power(exponent);
    for (const double x : {0.0, 1.0, -1.75, 3e-308, 1e300, -7e-200, std::numeric_limits<double>::infinity()}) {
      const double expected = std::ldexp(x, exponent), found = power.times(x);
      if (std::isnormal(expected) || expected == 0 || std::isinf(expected))
        EXPECT_EQ(found, expected) << x << " times 2^" << exponent;
      else  // subnormal: rounded once or twice
        EXPECT_NEAR(found, expected, std::numeric_limits<double>::denorm_min());
    }
  }
}

TEST(PowerOfTwo, OfANumberIsNotAboveItAndHasAnInverse) {
  for (const double x : {1.0, 1.99, 2.0, 3e-308, 1e-320, 0.0, 1e300, -5.0}) {
    const double power = magnitudeOf(x);
    int exponent = 0;
    EXPECT_EQ(std::frexp(power, &exponent), 0.5) << x;
    EXPECT_TRUE(std::isfinite(1 / power)) << x;
    if (std::abs(x) >= std::numeric_limits<double>::min()) {
      EXPECT_LE(power, std::abs(x));
      EXPECT_GT(2 * power, std::abs(x));
    }
  }
}

}  // namespace
}  // namespace tufted::power_of_two_test
