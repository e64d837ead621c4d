#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/types.h"

namespace tufted {

/// A surface assembled from triangles: no edge has more than two, and no two overlap around a corner in its tangent
/// plane (docs/algorithm.md, section 23).
class GrowingSurface {
 public:
  /// @param frames of the points; borrowed
  /// @param positions of the points; borrowed
  /// @param most N; maximum number of triangles at each point
  GrowingSurface(const Frames& frames, const Points& positions, const std::vector<int>& most);

  /// Adds a triangle if the surface allows it. False if not.
  bool add(const std::array<int, 3>& corners);
  /// Removes the triangle that was added last.
  void removeLast();

  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  /// Number of triangles at an edge.
  int facesAt(int a, int b) const;
  /// The other ends of the edges at a point that have one triangle, ascending.
  void openNeighbors(int point, std::vector<int>& neighbors) const;
  /// Number of fans that the triangles around a point form.
  int fansAround(int point) const;

 private:
  /// A triangle seen from one corner: the other two, counterclockwise in its tangent plane.
  struct Sector {
    int first, second;
    Eigen::Vector2f to_first, to_second;  ///< their directions from the corner, in its frame
  };

  std::span<const Sector> sectorsAt(int point) const { return {sectors_.data() + offset_[point], size_[point]}; }
  /// Whether a triangle may be added at one of its corners.
  bool fits(int point, const Sector& sector) const;
  Eigen::Vector2f direction(int from, int to) const;

  const Frames& frames_;
  const Points& positions_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::int64_t> offset_;  ///< N + 1; first place in `sectors_` of each point
  std::vector<std::uint32_t> size_;   ///< N
  std::vector<Sector> sectors_;
};

}  // namespace tufted
