#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace tufted {

/// Twice the area of a triangle in the plane, positive when it turns left.
inline double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// All points of the plane within `radius` of a segment.
struct Capsule {
  Eigen::Vector2d begin, end;
  double radius;
};

/// A counterclockwise triangle. It holds all points that are to the right of none of its edges, but not its corners.
class PlanarTriangle {
 public:
  /// @param area turn(a, b, c) > 0
  /// @param squared_edges the sum of the squares of the edges, finite
  PlanarTriangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c, double area,
                 double squared_edges);

  bool holds(const Eigen::Vector2d& point) const;
  /// True only if the triangle holds no point of the box from `low` to `high`.
  bool holdsNoneOf(const Eigen::Vector2d& low, const Eigen::Vector2d& high) const;
  bool holdsNoneOf(const Capsule& capsule) const;

 private:
  bool isCorner(const Eigen::Vector2d& point) const {
    return point == corner_[0] || point == corner_[1] || point == corner_[2];
  }

  std::array<Eigen::Vector2d, 3> corner_;
  Eigen::Vector2d low_, high_;  ///< a box around all points that the triangle holds
};

/// A k-d tree of the corners of a polygon, from which clipped corners are removed.
class CornerTree {
 public:
  /// Builds the tree of the finite points, which are borrowed.
  void build(const std::vector<Eigen::Vector2d>& points);
  void remove(int corner);

  /// The first remaining corner, in a fixed random order, that the triangle holds; -1 if there is none. For one
  /// triangle, until all n corners are removed in any order, the answer changes H_n < 1 + ln n times on average.
  int firstIn(const PlanarTriangle& triangle) const;

 private:
  struct Node {
    Eigen::Vector2d low, high;  ///< box around the remaining corners
    std::uint64_t first;        ///< the least place of a remaining corner in the random order
  };
  /// A node and its range of slots.
  struct Range {
    std::size_t node;
    int begin, end;

    int middle() const { return begin + (end - begin) / 2; }
    Range left() const { return {2 * node + 1, begin, middle()}; }
    Range right() const { return {2 * node + 2, middle(), end}; }
  };

  Range all() const { return {0, 0, static_cast<int>(corner_.size())}; }
  bool isLeaf(const Range& range) const { return 2 * range.node + 1 >= nodes_.size(); }
  void sort(const Range& range);
  void update(const Range& range);
  void remove(const Range& range, int slot);
  void search(const Range& range, const PlanarTriangle& triangle, std::uint64_t& first) const;

  const std::vector<Eigen::Vector2d>* points_ = nullptr;
  std::vector<int> corner_;  ///< by slot, those of a leaf consecutive; -1 once removed
  std::vector<int> slot_;    ///< slot of each corner; -1 if it is not finite
  std::vector<Node> nodes_;  ///< the children of node i are 2 i + 1 and 2 i + 2
  /// A capsule around the corners of each inner node: boxes of an oblique row of corners overlap thin triangles along
  /// it that hold none of them.
  std::vector<Capsule> capsules_;
};

}  // namespace tufted
