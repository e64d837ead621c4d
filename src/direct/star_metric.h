#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "cover/cover.h"
#include "cover/edge_lengths.h"
#include "stars/stars.h"

namespace tufted {

/// Cotangents, areas and mean lengths of all stars.
struct StarMetric {
  /// per link entry: sum over the two angles opposite the spoke, NaN without two triangles
  RawBuffer<double> cotan_sum;
  RawBuffer<double> area;           ///< n, area of the star
  RawBuffer<std::uint8_t> is_flat;  ///< n, 1 if a triangle of the star is flat, see flat_slack
  bool has_flat = false;            ///< whether any star is
  MeanLengths mean;                 ///< over all sides of all triangles
};

/// @param memory reused for cotan_sum: new pages cost more than what is written to them
StarMetric measureStars(const Stars& stars, const EdgeLengths& length, RawBuffer<double> memory,
                        const Workers& workers);

}  // namespace tufted
