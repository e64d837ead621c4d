#include "io/in_polygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tufted::io {
namespace {

using Eigen::Vector2d;

/// Exact sum of six products, as an expansion: parts of ascending size that do not overlap (Shewchuk 1997,
/// Grow-Expansion).
class ExactSum {
 public:
  void addProduct(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }

  int sign() const {
    const auto last = std::find_if(std::rbegin(parts_), std::rend(parts_), [](double part) { return part != 0; });
    return last == std::rend(parts_) ? 0 : *last > 0 ? 1 : -1;
  }

 private:
  void add(double value) {
    for (int i = 0; i < count_; ++i) {
      const double sum = parts_[i] + value, rounded = sum - parts_[i];
      parts_[i] = (parts_[i] - (sum - rounded)) + (value - rounded);  // what rounding of `sum` lost
      value = sum;
    }
    parts_[count_++] = value;
  }

  double parts_[12] = {};
  int count_ = 0;
};

/// The side of the line from a to b on which p lies: 1 left, -1 right, 0 on it.
int sideOf(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const double left = (b.x() - a.x()) * (p.y() - a.y()), right = (b.y() - a.y()) * (p.x() - a.x());
  constexpr double most_rounding = 4 * 0x1p-53;  // exceeds the bound of Orient2D, (3 + 16 u) u with u = 2^-53 (ibid.)
  if (std::abs(left - right) > most_rounding * (std::abs(left) + std::abs(right))) return left > right ? 1 : -1;
  ExactSum sum;
  sum.addProduct(a.x(), b.y());
  sum.addProduct(-a.x(), p.y());
  sum.addProduct(b.x(), p.y());
  sum.addProduct(-b.x(), a.y());
  sum.addProduct(p.x(), a.y());
  sum.addProduct(-p.x(), b.y());
  return sum.sign();
}

}  // namespace

bool isInside(const std::vector<Vector2d>& corners, const Vector2d& point) {
  bool is_inside = false;
  const Vector2d* start = &corners.back();
  for (const Vector2d& end : corners) {
    const auto& [low, high] = std::minmax(*std::exchange(start, &end), end,
                                          [](const Vector2d& a, const Vector2d& b) { return a.y() < b.y(); });
    if (!(point.y() >= low.y() && point.y() <= high.y())) continue;
    const int side = sideOf(low, high, point);
    if (side == 0 && point.x() >= std::min(low.x(), high.x()) && point.x() <= std::max(low.x(), high.x())) return true;
    // The ray to the right crosses an edge of which one end alone is above the ray.
    if (side > 0 && point.y() < high.y()) is_inside = !is_inside;
  }
  return is_inside;
}

}  // namespace tufted::io
