#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/buffer.h"
#include "neighbors/morton.h"
#include "neighbors/neighbors.h"
#include "tufted/report.h"
#include "tufted/scan_structure.h"

namespace tufted {

/// Neighbours of a point of a scan: those that were taken around it, without a tree.
class ScanSearch : public InWorkspace {
 public:
  struct Searched {
    double radius = 0;  ///< no other point of the surface around p is nearer, short of those that a ring's own hide
    int cut = 0;        ///< candidates left out because the surface jumps between p and them
  };

  virtual ~ScanSearch() = default;

  /// About k points around p, itself left out, ascending by (distance, index); fewer where the scan holds no more.
  /// `found` is overwritten and keeps its memory. Safe to call from several threads.
  virtual Searched nearest(int p, int k, Buffer<Neighbor>& found) const = 0;

  /// Whether a triangle of points leads across a jump of the surface that its corners may all be neighbours around.
  virtual bool spansJump(int /*a*/, int /*b*/, int /*c*/) const { return false; }

  /// Whether the points that nearest() returns get sparser with their distance, so that they are crowded in the middle.
  virtual bool isGraded() const = 0;

  virtual std::size_t bytes() const = 0;
};

/// The places of ranked points in a scan.
struct RankedScan {
  Buffer<int> row;          ///< n, -1: no place
  Buffer<double> position;  ///< n
  Eigen::Vector3d origin;   ///< in units of the cloud
  std::int64_t entries;     ///< of the structure: points of the caller, those that are not usable too
};

/// Brings a structure into rank order; of coincident points that with the smallest row and position stands for all.
/// @throws InvalidInput for arrays that do not have one entry per point, and columns of an image that are no columns
RankedScan rankScan(const ScanStructure& structure, const RankedCloud& cloud, const std::vector<PointStatus>& status,
                    const std::vector<int>& representative);

/// The search that fits the structure; counts the points without a place.
/// @param cloud borrowed for the life of the search
/// @throws InvalidInput as rankScan does
std::unique_ptr<ScanSearch> takeStructure(const ScanStructure& structure, const RankedCloud& cloud,
                                          const std::vector<PointStatus>& status,
                                          const std::vector<int>& representative, Report& report);

/// The two kinds of it.
std::unique_ptr<ScanSearch> imageSearch(const RankedScan& scan, const RankedCloud& cloud);
std::unique_ptr<ScanSearch> ringSearch(const RankedScan& scan, const RankedCloud& cloud);

}  // namespace tufted
