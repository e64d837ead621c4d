#pragma once

#include <cstdint>

#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// What a cloud is like, from its points and their nearest neighbours alone. Lengths are in the points' unit; they are
/// zero where fewer than two distinct points are finite.
struct CloudDescription {
  std::int64_t points = 0;                                  ///< N
  std::int64_t not_finite = 0;                              ///< points that are PointStatus::not_finite
  std::int64_t coincident = 0;                              ///< points that are PointStatus::coincident
  Eigen::RowVector3d lowest = Eigen::RowVector3d::Zero();   ///< least coordinates of the finite points
  Eigen::RowVector3d highest = Eigen::RowVector3d::Zero();  ///< greatest coordinates of the finite points
  double spacing = 0;                                       ///< median distance to the nearest neighbour
  double spacing_low = 0;                                   ///< 5th percentile of the distance to the nearest neighbour
  double spacing_high = 0;    ///< 95th percentile of the distance to the nearest neighbour
  double float_step = 0;      ///< distance of neighbouring floats at the farthest coordinate; infinite if there are
                              ///< none; not zero for a single point
  std::int64_t on_lines = 0;  ///< points whose k nearest neighbours lie on one line, as those on a scanner's rings do
  std::int64_t outliers = 0;  ///< points whose nearest neighbour is more than five times as far as is usual around them
  std::int64_t components = 0;  ///< connected components of the graph that joins each point with its k nearest
  int neighbors = 0;            ///< k in use
  double seconds = 0;           ///< time to sort the points and to find their neighbours
};

/// Describes a cloud before a Laplacian is built on it, at the cost of finding the neighbours.
/// @param options of which only `neighbors`, `threads` and `progress` are used
/// @throws InvalidInput for `neighbors` < 3 or `threads` < 0; Cancelled when `progress` returns false
CloudDescription describeCloud(const Points& points, const CloudOptions& options = {});

}  // namespace tufted
