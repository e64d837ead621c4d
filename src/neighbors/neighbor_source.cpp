#include "neighbors/neighbor_source.h"

#include <algorithm>
#include <cmath>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "base/stage_clock.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// Checks the caller's lists and brings them into rank order.
void takeNeighborhoods(const Neighborhoods& lists, const RankedCloud& cloud, const std::vector<PointStatus>& status,
                       const std::vector<int>& representative, NeighborSource& source, Report& report) {
  const int n = static_cast<int>(status.size());
  Buffer<int> rank(status.size(), -1);
  for (int r = 0; r < cloud.size(); ++r) rank[cloud.input_index[r]] = r;
  source.list_offset.assign(1, 0);
  for (int p = 0; p < cloud.size(); ++p) {
    const std::size_t start = source.list.size();
    for (Eigen::Index j = 0; j < lists.cols(); ++j) {
      const int index = lists(cloud.input_index[p], j);
      if (index < 0) continue;  // padding
      if (index >= n) {
        throw InvalidInput("pointCloudLaplacian: neighborhoods(" + std::to_string(cloud.input_index[p]) + ", " +
                           std::to_string(j) + ") = " + std::to_string(index) + ", must be less than " +
                           std::to_string(n) + ", the number of points");
      }
      const int q = rank[representative[index]];
      const bool repeats = std::find(source.list.begin() + start, source.list.end(), q) != source.list.end();
      if (q < 0 || q == p || repeats) {
        ++report.rejected_neighbors;
      } else {
        source.list.push_back(q);
      }
    }
    source.list_offset.push_back(source.list.size());
    source.k = std::max(source.k, static_cast<int>(source.list.size() - start));
  }
}

}  // namespace

double NeighborSource::nearest(const PointsView& points, int p, int count, Buffer<Neighbor>& found, NeighborOrder order,
                               SearchBefore* before) const {
  if (rings != nullptr) return rings->nearest(p, count, found);
  if (search != nullptr) {
    search->nearest(p, count, found, order, before);
  } else {
    found.clear();
    for (std::size_t i = list_offset[p]; i < list_offset[p + 1]; ++i)
      found.push_back({(points.row(list[i]) - points.row(p)).squaredNorm(), list[i]});
    std::sort(found.begin(), found.end());
  }
  return found.empty() ? 0 : std::sqrt(found.back().squared_distance);
}

std::size_t NeighborSource::bytes() const {
  if (search != nullptr) return search->bytes();
  if (rings != nullptr) return rings->bytes();
  return bytesOf(list) + bytesOf(list_offset);
}

PointBuffer rankedNormals(const Points* normals, const RankedCloud& cloud, Report& report) {
  PointBuffer ranked;
  if (normals == nullptr) return ranked;
  ranked.setZero(cloud.size());
  for (int p = 0; p < cloud.size(); ++p) {
    const Eigen::Vector3d normal = normals->row(cloud.input_index[p]);
    const double length = normal.stableNorm();
    if (length > 0 && std::isfinite(length)) {
      ranked.row(p) = (normal / length).normalized();
    } else {
      ++report.rejected_normals;
    }
  }
  return ranked;
}

NeighborSource neighborSource(const CloudOptions& options, const RankedCloud& cloud,
                              const std::vector<PointStatus>& status, const std::vector<int>& representative,
                              const Workers& workers, Report& report) {
  NeighborSource source;
  source.normals = rankedNormals(options.normals, cloud, report);
  if (options.neighborhoods != nullptr) {
    takeNeighborhoods(*options.neighborhoods, cloud, status, representative, source, report);
  } else {
    source.k = std::min(options.neighbors, std::max(0, cloud.size() - 1));
    report.neighbors_clamped = source.k < options.neighbors;
    if (options.structure != nullptr) {
      workers.report("tree", 0);
      const RankedScan scan = rankScan(*options.structure, cloud, status, representative);
      report.unplaced = std::count(scan.row.begin(), scan.row.end(), -1);
      source.rings = std::make_unique<RingSearch>(scan, cloud);
    } else {
      source.search = std::make_unique<NeighborSearch>(cloud.points, workers);
    }
  }
  report.neighbors = source.k;
  return source;
}

}  // namespace tufted
