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

/// The Delaunay stars of all points, one after the other, everything by rank.
///
/// Star p has the link vertices link[offset[p] .. offset[p + 1]), counterclockwise in the tangent plane of p. Entry i
/// stands for the triangle (p, link[i], successor of i). There is none at the last link vertex of an open star, and
/// where a filter dropped it.
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

/// What the steps from stars to the cover look at beside the stars: the neighbourhoods in which they were found.
struct StarSupport {
  RawBuffer<double> radius;          ///< circumradius in the tangent plane, per link entry as stars were wrapped
  RawBuffer<double> fit_radius;      ///< n, r_k: distance to the last neighbour before a star grows
  RawBuffer<std::uint8_t> isolated;  ///< n, 1 for points without a star: outliers, and where all others lie elsewhere
  PointBuffer normals;               ///< n x 3

  std::size_t bytes() const;
};

struct BuiltStars {
  Stars stars;
  StarSupport support;
};

/// For every point the neighbourhood, the tangent frame, the projection and the Delaunay star with its certificate.
/// Counts growth, splits and open stars, and books the three stages' costs.
BuiltStars buildStars(const RankedCloud& cloud, const NeighborSource& source, const CloudOptions& options,
                      const Workers& workers, Report& report);

}  // namespace tufted
