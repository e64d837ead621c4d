#include "polygons/corner_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/infinity.h"

namespace tufted {
namespace {

using Eigen::Vector2d;

/// Greatest number of corners in a leaf.
constexpr int leaf_size = 16;
constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();

/// The place of a corner in the random order: hashed bits (the finaliser of MurmurHash3), then its number.
std::uint64_t placeOf(int corner) {
  auto bits = static_cast<std::uint32_t>(corner);
  bits = (bits ^ bits >> 16) * 0x85ebca6bu;
  bits = (bits ^ bits >> 13) * 0xc2b2ae35u;
  return static_cast<std::uint64_t>(bits ^ bits >> 16) << 32 | static_cast<std::uint32_t>(corner);
}

double distance(const Vector2d& point, const Capsule& capsule) {
  const Vector2d along = capsule.end - capsule.begin, offset = point - capsule.begin;
  const double length = along.squaredNorm();
  if (!std::isfinite(length)) return infinity;
  const double part = length > 0 ? std::clamp(offset.dot(along) / length, 0.0, 1.0) : 0;
  return (offset - part * along).norm();
}

}  // namespace

/// Because of rounding, holds() accepts points beside the triangle, too. Its turns are wrong by less than 5 u |edge|
/// |distance| with u = 2^-53. From a point that is g outside of the corners' box, in x or y, one of the three true
/// turns is at most -area g / (2 s) with s^2 = squared_edges, and no corner is farther than sqrt(2) (g + s). So g < 32
/// u s^3 / area if area > 64 u s^2, and twice that is the margin. Thinner triangles, and those whose products
/// underflow, get no box.
PlanarTriangle::PlanarTriangle(const Vector2d& a, const Vector2d& b, const Vector2d& c, double area,
                               double squared_edges)
    : corner_{a, b, c} {
  // Bound on the relative rounding of turn().
  constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();
  // Smaller products may have underflowed.
  constexpr double least = 1e-280;
  const bool has_box = area > rounding * squared_edges && squared_edges > least;
  const double margin = has_box ? rounding * squared_edges / area * std::sqrt(squared_edges) : infinity;
  low_ = a.cwiseMin(b).cwiseMin(c).array() - margin;
  high_ = a.cwiseMax(b).cwiseMax(c).array() + margin;
}

bool PlanarTriangle::holds(const Vector2d& point) const {
  if (isCorner(point)) return false;
  for (int i = 0; i < 3; ++i)
    if (!(turn(corner_[i], corner_[(i + 1) % 3], point) >= 0)) return false;
  return true;
}

bool PlanarTriangle::holdsNoneOf(const Vector2d& low, const Vector2d& high) const {
  if ((high.array() < low_.array()).any() || (low.array() > high_.array()).any()) return true;
  if (low == high && isCorner(low)) return true;  // copies of one position
  for (int i = 0; i < 3; ++i) {
    // The corner of the box that is farthest to the left of the edge. Each operation of turn() is monotone, and so is
    // its rounding.
    const Vector2d &from = corner_[i], &to = corner_[(i + 1) % 3];
    const Vector2d farthest(to.y() >= from.y() ? low.x() : high.x(), to.x() >= from.x() ? high.y() : low.y());
    if (turn(from, to, farthest) < 0) return true;
  }
  return false;
}

bool PlanarTriangle::holdsNoneOf(const Capsule& capsule) const {
  // Bound on the relative rounding of distances.
  constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();
  if (low_.x() == -infinity) return false;
  for (int i = 0; i < 3; ++i) {
    const Vector2d &from = corner_[i], &to = corner_[(i + 1) % 3];
    const double edge = (to - from).norm();
    const double reach = (capsule.begin - from).norm() + (capsule.end - from).norm() + capsule.radius;
    const double farthest = std::max(turn(from, to, capsule.begin), turn(from, to, capsule.end));
    if (farthest + edge * (capsule.radius + rounding * reach) < 0) return true;
  }
  return false;
}

void CornerTree::build(const std::vector<Vector2d>& points) {
  points_ = &points;
  corner_.clear();
  slot_.assign(points.size(), -1);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite()) corner_.push_back(static_cast<int>(i));
  std::size_t leaves = 1;
  while (leaves * leaf_size < corner_.size()) leaves *= 2;
  nodes_.resize(2 * leaves - 1);
  capsules_.resize(leaves - 1);
  sort(all());
  for (std::size_t slot = 0; slot < corner_.size(); ++slot) slot_[corner_[slot]] = static_cast<int>(slot);
}

void CornerTree::sort(const Range& range) {
  if (isLeaf(range)) return update(range);
  Vector2d low = Vector2d::Constant(infinity), high = -low;
  for (int slot = range.begin; slot < range.end; ++slot) {
    low = low.cwiseMin((*points_)[corner_[slot]]);
    high = high.cwiseMax((*points_)[corner_[slot]]);
  }
  const int axis = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
  const auto isBefore = [this, axis](int i, int j) { return (*points_)[i][axis] < (*points_)[j][axis]; };
  const auto begin = corner_.begin() + range.begin, end = corner_.begin() + range.end;
  const auto [least, greatest] = std::minmax_element(begin, end, isBefore);
  Capsule capsule = {(*points_)[*least], (*points_)[*greatest], 0};
  for (auto corner = begin; corner != end; ++corner)
    capsule.radius = std::max(capsule.radius, distance((*points_)[*corner], capsule));
  capsules_[range.node] = capsule;
  std::nth_element(begin, corner_.begin() + range.middle(), end, isBefore);
  sort(range.left());
  sort(range.right());
  update(range);
}

void CornerTree::update(const Range& range) {
  Node node = {Vector2d::Constant(infinity), Vector2d::Constant(-infinity), none};
  const auto add = [&node](const Vector2d& low, const Vector2d& high, std::uint64_t first) {
    node.low = node.low.cwiseMin(low);
    node.high = node.high.cwiseMax(high);
    node.first = std::min(node.first, first);
  };
  if (isLeaf(range)) {
    for (int slot = range.begin; slot < range.end; ++slot)
      if (const int corner = corner_[slot]; corner >= 0) add((*points_)[corner], (*points_)[corner], placeOf(corner));
  } else {
    for (const Range& half : {range.left(), range.right()})
      add(nodes_[half.node].low, nodes_[half.node].high, nodes_[half.node].first);
  }
  nodes_[range.node] = node;
}

void CornerTree::remove(int corner) {
  if (slot_[corner] >= 0) remove(all(), slot_[corner]);
}

void CornerTree::remove(const Range& range, int slot) {
  if (isLeaf(range))
    corner_[slot] = -1;
  else
    remove(slot < range.middle() ? range.left() : range.right(), slot);
  update(range);
}

int CornerTree::firstIn(const PlanarTriangle& triangle) const {
  std::uint64_t first = none;
  search(all(), triangle, first);
  return first == none ? -1 : static_cast<int>(first & 0xffffffffu);
}

void CornerTree::search(const Range& range, const PlanarTriangle& triangle, std::uint64_t& first) const {
  const Node& node = nodes_[range.node];
  if (node.first >= first || triangle.holdsNoneOf(node.low, node.high)) return;
  if (isLeaf(range)) {
    for (int slot = range.begin; slot < range.end; ++slot) {
      const int corner = corner_[slot];
      if (corner >= 0 && placeOf(corner) < first && triangle.holds((*points_)[corner])) first = placeOf(corner);
    }
    return;
  }
  if (triangle.holdsNoneOf(capsules_[range.node])) return;
  const Range left = range.left(), right = range.right();
  const bool left_first = nodes_[left.node].first < nodes_[right.node].first;
  search(left_first ? left : right, triangle, first);
  search(left_first ? right : left, triangle, first);
}

}  // namespace tufted
