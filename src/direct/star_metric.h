#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "cover/cover.h"
#include "cover/edge_lengths.h"
#include "stars/stars.h"

namespace tufted {

/// What the lengths of the edges say about every star.
struct StarMetric {
  RawBuffer<double> cotan_sum;      ///< per link entry: of the two angles opposite the spoke, NaN without two triangles
  RawBuffer<double> area;           ///< n, of the star's triangles
  RawBuffer<std::uint8_t> is_flat;  ///< n, 1 where a triangle of the star is flat, see flat_slack
  bool has_flat = false;            ///< whether any is
  MeanLengths mean;                 ///< over all sides of all triangles
};

/// @param memory for cotan_sum, whatever is in it: new pages cost more than what is written to them
StarMetric measureStars(const Stars& stars, const EdgeLengths& length, RawBuffer<double> memory,
                        const Workers& workers);

}  // namespace tufted
