#pragma once

#include <cstdint>

#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// What a cloud is like, from its points and their nearest neighbours alone. Lengths are in the points' unit; they are
/// zero where fewer than two distinct points are finite.
struct CloudDescription {
  std::int64_t points = 0;
  std::int64_t not_finite = 0;  ///< as PointStatus::not_finite
  std::int64_t coincident = 0;  ///< as PointStatus::coincident
  Eigen::RowVector3d lowest = Eigen::RowVector3d::Zero(), highest = Eigen::RowVector3d::Zero();  ///< of finite points
  double spacing = 0;         ///< median distance to the nearest neighbour
  double spacing_low = 0;     ///< below which it is for one point in twenty
  double spacing_high = 0;    ///< above which it is for one point in twenty
  double float_step = 0;      ///< distance of neighbouring floats at the farthest coordinate; infinite where none are;
                              ///< not zero for a single point
  std::int64_t on_lines = 0;  ///< points whose k nearest neighbours lie on one line, as those on a scanner's rings do
  std::int64_t outliers = 0;  ///< points whose nearest neighbour is more than five times as far as is usual around them
  std::int64_t components = 0;  ///< of the graph that joins each point with its k nearest
  int neighbors = 0;            ///< k in use
  double seconds = 0;           ///< that sorting the points and finding their neighbours took
};

/// Describes a cloud before a Laplacian is built on it, at the cost of finding the neighbours.
/// @param options `neighbors`, `threads` and `progress` of them count
/// @throws InvalidInput for `neighbors` < 3 or `threads` < 0; Cancelled when `progress` returns false
CloudDescription describeCloud(const Points& points, const CloudOptions& options = {});

}  // namespace tufted
