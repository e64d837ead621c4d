#include "shapes/random.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace tufted::shapes {

double Random::uniform() {
  return static_cast<double>(engine_() >> 11) * 0x1p-53;
}

double Random::uniform(double low, double high) {
  return low + (high - low) * uniform();
}

double Random::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  // Box-Muller method, rounded because mathematical libraries differ in the last bits of log and cos.
  const auto rounded = [](double x) { return std::nearbyint(x * 0x1p36) * 0x1p-36; };
  const double radius = std::sqrt(-2 * std::log(1 - uniform()));
  const double angle = 2 * std::numbers::pi * uniform();
  spare_ = rounded(radius * std::sin(angle));
  has_spare_ = true;
  return rounded(radius * std::cos(angle));
}

int Random::below(int n) {
  return static_cast<int>(uniform() * n);
}

std::vector<int> Random::permutation(int n) {
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  for (int i = n - 1; i > 0; --i) std::swap(order[i], order[below(i + 1)]);
  return order;
}

}  // namespace tufted::shapes
