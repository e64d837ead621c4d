#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace tufted::shapes {

/// Seeded random numbers that are the same with every standard library. The standard defines the output of the engine,
/// but not that of its distributions, so these are our own.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform();                         ///< in [0, 1), a multiple of 2^-53
  double uniform(double low, double high);  ///< in [low, high)
  double normal();                          ///< mean 0, variance 1, a multiple of 2^-36
  int below(int n);                         ///< in 0 .. n-1
  std::vector<int> permutation(int n);      ///< 0 .. n-1 in random order

 private:
  std::mt19937_64 engine_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace tufted::shapes
