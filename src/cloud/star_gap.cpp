#include "cloud/star_gap.h"

#include <Eigen/Core>
#include <cmath>

namespace tufted {
namespace {

constexpr double margin = 1e-9;  // sine of an angle, a million times what rounding makes of it

}  // namespace

StarGap::StarGap(const DelaunayStar& star) {
  if (star.link.empty()) return;
  const PlanarPoint &first = star.link.front(), &last = star.link.back();
  const Eigen::Vector2d middle =
      -Eigen::Vector2d(first.u, first.v).normalized() - Eigen::Vector2d(last.u, last.v).normalized();
  x_ = middle.x();
  y_ = middle.y();
}

void StarGap::narrow(const PlanarOffsets& points) {
  for (int i = 0; i < points.count; ++i) {
    const double along = points.u[i] * x_ + points.v[i] * y_, across = points.v[i] * x_ - points.u[i] * y_;
    const double size = std::abs(along) + std::abs(across);
    const double key = 1 - along / size;  // NaN at the origin, which is nearer than nothing
    Side& side = across >= 0 ? left_ : right_;
    if (key < side.key) side = {key, along, across};
  }
}

bool StarGap::isOpen() const {
  const auto sizeOf = [](const Side& side) { return std::abs(side.along) + std::abs(side.across); };
  const double cross = right_.along * left_.across - right_.across * left_.along;
  return cross < -margin * sizeOf(left_) * sizeOf(right_);
}

}  // namespace tufted
