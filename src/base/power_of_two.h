#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace tufted {

/// Multiplies by a power of two, exactly unless the product is subnormal; much cheaper than std::ldexp.
class PowerOfTwo {
 public:
  /// 2^exponent, for exponents from -3000 to 3000, although 2^exponent itself may not fit a double.
  explicit PowerOfTwo(int exponent)
      : third_(std::ldexp(1.0, exponent / 3)), rest_(std::ldexp(1.0, exponent - 2 * (exponent / 3))) {}

  double times(double x) const { return x * third_ * third_ * rest_; }
  /// Adds times(x) to `sum`, but not a product of 0, which would turn a sum of -0 into 0.
  void addTo(double& sum, double x) const {
    const double product = times(x);
    if (product != 0) sum += product;
  }

 private:
  double third_, rest_;
};

/// The largest power of two that is not above |x|, but at least 2^-1022, so that its inverse is a double too.
inline double magnitudeOf(double x) {
  // Mask of the exponent of a double.
  constexpr std::uint64_t exponent_bits = 0x7FF0000000000000;
  const auto power = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & exponent_bits);
  return power > 0 ? power : 0x1p-1022;
}

}  // namespace tufted
