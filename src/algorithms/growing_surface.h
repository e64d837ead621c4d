#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/types.h"

namespace tufted {

/// A surface that is put together from triangles: no edge gets three, and around no corner do two of them overlap in
/// its tangent plane.
class GrowingSurface {
 public:
  /// @param frames of the points, in whose planes triangles are compared; borrowed
  /// @param positions of the points; borrowed
  /// @param most how many triangles there may be at each point
  GrowingSurface(const Frames& frames, const Points& positions, const std::vector<int>& most);

  /// Adds a triangle if it fits.
  bool add(const std::array<int, 3>& corners);
  /// Takes back the triangle that was added last.
  void removeLast();

  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  /// How many triangles have the edge.
  int facesAt(int a, int b) const;
  /// The other ends of the edges of one triangle at a point.
  void openNeighbors(int point, std::vector<int>& neighbors) const;
  /// The fans that the triangles around a point form.
  int fansAround(int point) const;

 private:
  /// A triangle at one of its corners: the other two, counterclockwise in the tangent plane.
  struct Sector {
    int first, second;
    Eigen::Vector2f to_first, to_second;  ///< their directions
  };

  std::span<const Sector> sectorsAt(int point) const { return {sectors_.data() + offset_[point], size_[point]}; }
  /// Whether there is room for a triangle at a corner, and it overlaps none of those there.
  bool fits(int point, const Sector& sector) const;
  Eigen::Vector2f direction(int from, int to) const;

  const Frames& frames_;
  const Points& positions_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::int64_t> offset_;  ///< N + 1, of the sectors of each point
  std::vector<std::uint32_t> size_;   ///< N
  std::vector<Sector> sectors_;
};

}  // namespace tufted
