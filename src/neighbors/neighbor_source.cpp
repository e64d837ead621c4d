#include "neighbors/neighbor_source.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

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

/// Whether the azimuths of a scan lead to nearby points, as those of another scan, or equal ones, do not: most of a
/// sample of points must find the nearest point of their ring and of the two rings beside it, or one at most twice
/// as far, unless that lies beyond the ball that is searched. Rounded azimuths pass as long as few points share one.
bool azimuthsFit(const RankedScan& scan, const RankedCloud& cloud, const RingSearch& search, int k) {
  // Number of sampled points; each is compared with all points of three rings.
  constexpr int samples = 512;
  // Mean number of points of a ring with the same azimuth at most: the search of a ring takes that many on each side.
  constexpr std::size_t most_at_once = 16;
  // Share of the sampled points. Azimuths blurred by a degree fit 0.93 of them; if a fifth of all is 0, as drivers
  // leave them, 0.82 fit at most.
  constexpr double least_fitting = 0.875;
  // The points of each ring that has any.
  std::map<int, Buffer<int>> rings;
  for (int p = 0; p < cloud.size(); ++p)
    if (scan.row[p] >= 0) rings[scan.row[p]].push_back(p);
  std::size_t places = 0, points = 0;
  for (const auto& [row, ring] : rings) {
    std::set<double> azimuths;
    for (const int p : ring) azimuths.insert(scan.position[p]);
    places += azimuths.size();
    points += ring.size();
  }
  if (points > most_at_once * places) return false;
  const auto squaredDistance = [&cloud](int p, int q) {
    return (cloud.points.row(p) - cloud.points.row(q)).squaredNorm();
  };
  Buffer<Neighbor> found;
  const auto findsNearestOn = [&](int p, const std::pair<const int, Buffer<int>>& ring, double radius) {
    double nearest = HUGE_VAL, nearest_found = HUGE_VAL;
    for (const int q : ring.second)
      if (q != p) nearest = std::min(nearest, squaredDistance(p, q));
    for (const Neighbor& q : found)
      if (scan.row[q.index] == ring.first) nearest_found = std::min(nearest_found, q.squared_distance);
    return nearest > radius * radius || nearest_found <= 4 * nearest;
  };
  const int stride = std::max(1, cloud.size() / samples) | 1;
  int asked = 0, fitting = 0;
  for (int p = 0; p < cloud.size(); p += stride) {
    if (scan.row[p] < 0) continue;
    const double radius = search.nearest(p, k, found);
    const auto own = rings.find(scan.row[p]), above = std::next(own);
    const bool fits = findsNearestOn(p, *own, radius) && (above == rings.end() || findsNearestOn(p, *above, radius)) &&
                      (own == rings.begin() || findsNearestOn(p, *std::prev(own), radius));
    ++asked;
    fitting += fits ? 1 : 0;
  }
  return fitting >= least_fitting * asked;
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
      if (!azimuthsFit(scan, cloud, *source.rings, source.k))
        throw InvalidInput(
            "pointCloudLaplacian: structure.position: points at nearly the same azimuth of a ring, or of rings that "
            "follow each other, lie far apart, must lie side by side (are these the azimuths of these points?)");
    } else {
      source.search = std::make_unique<NeighborSearch>(cloud.points, workers);
    }
  }
  report.neighbors = source.k;
  return source;
}

}  // namespace tufted
