#pragma once

#include <algorithm>
#include <cstdint>

#include "base/parallel.h"
#include "base/point_buffer.h"
#include "base/stage_clock.h"
#include "neighbors/morton.h"
#include "neighbors/neighbor_source.h"
#include "tufted/options.h"
#include "tufted/report.h"

namespace tufted {

/// The Delaunay stars of all points, stored one after the other, by rank.
///
/// Star p has the link vertices link[offset[p] .. offset[p + 1]), counterclockwise in the tangent plane of p. Entry i
/// stands for the triangle (p, link[i], successor of i). There is no triangle at the last link vertex of an open star
/// and where a filter dropped it.
struct Stars {
  Buffer<int> offset;                ///< n + 1
  RawBuffer<int> link;               ///< ranks
  RawBuffer<std::uint8_t> triangle;  ///< per link entry, 0 where there is no triangle
  RawBuffer<std::uint8_t> ends;      ///< n, 1 where the surface ends at p: an open star or a lost triangle

  int size() const { return std::max(0, static_cast<int>(offset.size()) - 1); }
  /// The link entry after i in star p, cyclically.
  int after(int p, int i) const { return i + 1 == offset[p + 1] ? offset[p] : i + 1; }
  bool hasTriangle(int i) const { return triangle[i] != 0; }
  std::int64_t triangles() const;
  std::size_t bytes() const;
};

/// What later steps need of the neighbourhoods in which the stars were found.
struct StarSupport {
  RawBuffer<double> radius;  ///< circumradius in the tangent plane, per link entry; not updated when stars change later
  RawBuffer<double> fit_radius;  ///< n, S(p): distance to the last neighbour of the plane
  RawBuffer<double> reach;  ///< n, how far neighbours were searched around p: no point farther away changes its star
  /// n, how far findBoundary() has searched around p: no point farther away changes its label; empty before
  Buffer<double> boundary_reach;
  /// n, 1 for points without a star: outliers, and points whose neighbours lie on other sheets
  RawBuffer<std::uint8_t> isolated;
  PointBuffer normals;  ///< n x 3

  std::size_t bytes() const;
};

struct BuiltStars {
  Stars stars;
  StarSupport support;
};

/// Finds neighbourhood, tangent plane and Delaunay star of every point (sections 3, 4 and 6 of docs/algorithm.md).
/// Reports growth, splits, open stars and the cost of three stages.
BuiltStars buildStars(const RankedCloud& cloud, const NeighborSource& source, const CloudOptions& options,
                      const Workers& workers, Report& report);

}  // namespace tufted
