#pragma once

#include <cstdint>
#include <vector>

#include "base/buffer.h"
#include "neighbors/morton.h"
#include "tufted/report.h"
#include "tufted/scan_structure.h"

namespace tufted {

/// The places of ranked points in a scan.
struct RankedScan {
  Buffer<int> row;          ///< n, -1: no place
  Buffer<double> position;  ///< n
  Eigen::Vector3d origin;   ///< in units of the cloud
  std::int64_t entries;     ///< of the structure: points of the caller, those that are not usable too
  const char* function;     ///< of the library that was called, for messages
};

/// Brings a structure into rank order; of coincident points that with the smallest row and position stands for all.
/// @param function of the library that was called, for messages; a literal
/// @throws InvalidInput for arrays that do not have one entry per point, and columns of an image that are no columns
RankedScan rankScan(const ScanStructure& structure, const RankedCloud& cloud, const std::vector<PointStatus>& status,
                    const std::vector<int>& representative, const char* function = "pointCloudLaplacian");

}  // namespace tufted
