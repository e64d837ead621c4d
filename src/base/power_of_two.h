#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace tufted {

/// Multiplies by a power of two, like std::ldexp at a fraction of its cost: exact unless the product is subnormal.
class PowerOfTwo {
 public:
  /// 2^exponent, also where no double is that large or small.
  explicit PowerOfTwo(int exponent)
      : first_(std::ldexp(1.0, exponent / 2)), second_(std::ldexp(1.0, exponent - exponent / 2)) {}

  double times(double x) const { return x * first_ * second_; }

 private:
  double first_, second_;
};

/// The largest power of two that is not above |x|, but at least 2^-1022, so that its inverse is a double too.
inline double magnitudeOf(double x) {
  constexpr std::uint64_t exponent_bits = 0x7FF0000000000000;
  const auto power = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & exponent_bits);
  return power > 0 ? power : 0x1p-1022;
}

}  // namespace tufted
