#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace tufted {

/// Bounding box of some points, in scaled coordinates.
struct CellBox {
  Eigen::Array3d least = Eigen::Array3d::Constant(HUGE_VAL);
  Eigen::Array3d greatest = Eigen::Array3d::Constant(-HUGE_VAL);

  void widen(const CellBox& other) {
    least = least.min(other.least);
    greatest = greatest.max(other.greatest);
  }
  static CellBox of(const Eigen::Array3d& point) { return {point, point}; }
  /// The least distance between points of two boxes.
  double gapTo(const CellBox& other) const {
    return (other.least - greatest).max(least - other.greatest).max(0).matrix().norm();
  }
};

/// The cells of a grid that hold points, in the order of the Morton curve, so that the points of consecutive cells are
/// consecutive in rank.
class Cells {
 public:
  /// @param edge of the cubes of the grid, in scaled coordinates
  /// @param begin for each cell the number of points before it, and the end
  /// @param boxes of the points of each cell
  Cells(double edge, std::vector<std::int64_t> begin, std::vector<CellBox> boxes);

  int size() const { return static_cast<int>(begin_.size()) - 1; }
  std::int64_t begin(int cell) const { return begin_[cell]; }
  std::int64_t points(int cell) const { return begin_[cell + 1] - begin_[cell]; }
  const CellBox& box(int cell) const { return tree_[0][cell]; }
  double edge() const { return edge_; }
  /// Whether two cells are near each other: at most an edge apart.
  bool areNear(int a, int b) const { return box(a).gapTo(box(b)) <= edge_; }

  /// Calls visit(cell) for all cells at most `radius` from a box.
  template <class Visit>
  void visit(const CellBox& from, double radius, const Visit& visit) const {
    if (size() > 0) visitNode(static_cast<int>(tree_.size()) - 1, 0, from, radius * (1 + slack), visit);
  }
  template <class Visit>
  void visitNear(int cell, const Visit& visit) const {
    this->visit(box(cell), edge_, visit);
  }

 private:
  static constexpr int fan = 8;           ///< runs of 8 cells that hold points have a box of the next level, and so on
  static constexpr double slack = 1e-12;  ///< radii and distances are rounded

  template <class Visit>
  void visitNode(int level, int node, const CellBox& from, double radius, const Visit& visit) const {
    if (!(tree_[level][node].gapTo(from) <= radius)) return;
    if (level == 0) return visit(node);
    const int end = std::min(static_cast<int>(tree_[level - 1].size()), fan * (node + 1));
    for (int child = fan * node; child < end; ++child) visitNode(level - 1, child, from, radius, visit);
  }

  double edge_;
  std::vector<std::int64_t> begin_;
  std::vector<std::vector<CellBox>> tree_;  ///< boxes of cells, of runs of `fan` cells, ...; the last level has one
};

}  // namespace tufted
