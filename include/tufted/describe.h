#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// Size, spacing and defects of a cloud, from its points and their nearest neighbours alone. Lengths are in the points'
/// unit; they are 0 if fewer than two distinct points are finite.
struct CloudDescription {
  std::int64_t points = 0;                                  ///< N
  std::int64_t sampled = 0;                                 ///< points that were looked at, N or those of a sample
  std::int64_t not_finite = 0;                              ///< points of PointStatus::not_finite
  std::int64_t coincident = 0;                              ///< points of PointStatus::coincident
  Eigen::RowVector3d lowest = Eigen::RowVector3d::Zero();   ///< least coordinates of the finite points
  Eigen::RowVector3d highest = Eigen::RowVector3d::Zero();  ///< greatest coordinates of the finite points
  double spacing = 0;                                       ///< median distance to the nearest neighbour
  double spacing_low = 0;                                   ///< 5th percentile of the distance to the nearest neighbour
  double spacing_high = 0;    ///< 95th percentile of the distance to the nearest neighbour
  double float_step = 0;      ///< distance between neighbouring floats at the largest absolute coordinate; infinite if
                              ///< that exceeds all floats; set also for a single point
  std::int64_t on_lines = 0;  ///< points whose k nearest neighbours lie on one line, as on a ring of a scanner
  std::int64_t outliers = 0;  ///< points whose nearest neighbour is more than five times as far as the median nearest
                              ///< neighbour of their k neighbours
  std::int64_t components = 0;  ///< connected components of the graph that joins each point to its k nearest
  int neighbors = 0;            ///< k in use, clamped to the number of other distinct points
  double seconds = 0;           ///< time to sort the points and to find their neighbours
};

/// Describes a cloud before a Laplacian is built from it. Takes about as long as finding the neighbours.
/// @param points N x 3; points that are not finite are counted and skipped
/// @param options only `neighbors`, `threads` and `progress` are used
/// @throws InvalidInput for `neighbors` < 3 or `threads` < 0
/// @throws Cancelled when `progress` returns false
CloudDescription describeCloud(const Points& points, const CloudOptions& options = {});

/// Describes a large cloud by a sample of it. `points`, `not_finite`, `lowest`, `highest` and `float_step` are those of
/// the whole cloud, all other members those of the sample.
/// @param points N x 3
/// @param sample indices, such as those of sampleRegions()
/// @param options as for describeCloud()
/// @throws InvalidInput and Cancelled as describeCloud(), and InvalidInput for an index that is not in [0, N)
CloudDescription describeSample(const Points& points, const std::vector<int>& sample, const CloudOptions& options = {});

/// A sample of a large cloud with the spacing of the whole: all points of some balls whose centres are spread over the
/// order of the points. Takes one pass over the points.
/// @param points N x 3; points that are not finite are never in the sample, unless it is the whole cloud
/// @param most greatest size of the sample, at least 1000; a cloud of at most that many points is its own sample
/// @return indices, ascending
/// @throws InvalidInput for a smaller `most`
std::vector<int> sampleRegions(const Points& points, int most);

/// A sentence to warn of points that hover over a surface seen from above, as vegetation does in an airborne scan.
/// Looks at 50,000 points at most. Not for depth images, whose bodies lie one before the other.
/// @param points N x 3, z upwards
/// @return empty if no such points were found, or if fewer than 1000 distinct points are finite
std::string hoveringWarning(const Points& points);

}  // namespace tufted
