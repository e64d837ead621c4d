#pragma once

#include <cstdint>
#include <vector>

#include "base/buffer.h"
#include "neighbors/morton.h"
#include "tufted/report.h"
#include "tufted/scan_structure.h"

namespace tufted {

/// Rows and positions of the points of a scan, by rank.
struct RankedScan {
  Buffer<int> row;  ///< n; -1: none
  /// n; columns, or azimuths in [0, 2 pi).
  Buffer<double> position;  ///< n
  Eigen::Vector3d origin;   ///< the sensor, in units of the ranked cloud
  std::int64_t entries;     ///< size of the caller's structure, unusable points included
  const char* function;     ///< the public function that was called, for messages
};

/// Brings a structure into rank order. Coincident points get the smallest (row, position) among them.
/// @param function the public function that was called, for messages; a literal
/// @throws InvalidInput for arrays that do not have one entry per point, an origin that is not finite, and columns of
/// an image that are not whole numbers >= 0
RankedScan rankScan(const ScanStructure& structure, const RankedCloud& cloud, const std::vector<PointStatus>& status,
                    const std::vector<int>& representative, const char* function = "pointCloudLaplacian");

}  // namespace tufted
