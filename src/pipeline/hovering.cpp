#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "base/buffer.h"
#include "neighbors/morton.h"
#include "neighbors/neighbors.h"
#include "stars/tangent_frame.h"
#include "tufted/describe.h"

namespace tufted {
namespace {

constexpr int hovering_sample = 50000;  ///< points that are looked at, in a tenth of a second
constexpr int least_count = 1000;       ///< fewer points say too little about a share of a hundredth
constexpr int hovering_neighbors = 30;  ///< number of neighbours, as in a build
constexpr std::size_t least_cell = 8;   ///< points in a cell, most of which are on the lower one of two layers

/// A neighbourhood fills a volume if it is thick, and if fewer than this share of the neighbours are within half the
/// distance of the last one. That share is 1/4 on a surface and 1/8 in a volume, and this is the geometric mean.
constexpr double filled_share = 0.177;
/// Below this share of such neighbourhoods there is no warning: at most 0.006 on nine scans from one side without
/// trees, 0.013 to 0.07 on three airborne scans with trees.
constexpr double least_filled = 0.01;
/// If more points than this are off the middle of their cell, the cloud is not seen from above: at most 0.15 on scans
/// from one side, at least 0.29 on bodies from all sides.
constexpr double most_off = 0.25;

/// Counts the points that are higher or lower than the middle one of their cell by more than the width of the cell.
/// Cells are the leaves of a tree of medians in x and y.
std::ptrdiff_t countOff(const Points& points, std::span<int> cell) {
  const auto less = [&](int axis) { return [&, axis](int i, int j) { return points(i, axis) < points(j, axis); }; };
  const auto width = [&](int axis) {
    const auto [low, high] = std::minmax_element(cell.begin(), cell.end(), less(axis));
    return points(*high, axis) - points(*low, axis);
  };
  const double x = width(0), y = width(1);
  const std::size_t half = cell.size() / 2;
  const auto middle = cell.begin() + static_cast<std::ptrdiff_t>(half);
  const bool is_leaf = half < least_cell;
  std::nth_element(cell.begin(), middle, cell.end(), less(is_leaf ? 2 : x < y ? 1 : 0));
  if (!is_leaf) return countOff(points, cell.first(half)) + countOff(points, cell.subspan(half));
  const double height = points(*middle, 2);
  return std::count_if(cell.begin(), cell.end(),
                       [&](int i) { return std::abs(points(i, 2) - height) > std::max(x, y); });
}

/// Counts the points whose neighbourhood fills a volume.
std::ptrdiff_t countFilled(const RankedCloud& cloud) {
  const NeighborSearch search(cloud.points);
  Buffer<Neighbor> found;
  std::ptrdiff_t count = 0;
  for (int p = 0; p < cloud.size(); ++p) {
    search.nearest(p, hovering_neighbors, found);
    const double quarter = found[hovering_neighbors - 1].squared_distance / 4;
    const auto inner = std::count_if(found.begin(), found.end(),
                                     [&](const Neighbor& neighbor) { return neighbor.squared_distance < quarter; });
    if (static_cast<double>(inner) > filled_share * (hovering_neighbors - 1)) continue;
    const PrincipalAxes axes = principalAxes(cloud.points, p, found);
    count += areThick(axes) ? 1 : 0;
  }
  return count;
}

}  // namespace

std::string hoveringWarning(const Points& points) {
  const Points some = points(sampleRegions(points, hovering_sample), Eigen::all);
  std::vector<PointStatus> status;
  std::vector<int> representative;
  const RankedCloud cloud = rankPoints(some, status, representative);
  if (cloud.size() < least_count) return "";
  std::vector<int> distinct(cloud.input_index.begin(), cloud.input_index.end());
  const double off = static_cast<double>(countOff(some, distinct)) / cloud.size();
  if (off < least_filled || off > most_off) return "";
  const double filled = static_cast<double>(countFilled(cloud)) / cloud.size();
  // Noise fills volumes as well, but stays within the cells.
  if (filled < least_filled || filled > off) return "";
  char share[32];
  std::snprintf(share, sizeof share, "%.2g %%", 100 * filled);
  return std::string(share) +
         " of the points fill volumes over or under others, as vegetation does above the ground: areas and distances "
         "may be far off; leave such points out by class, return or place (--where and --crop of the command, where "
         "and crop of read() in Python, select() in C++)";
}

}  // namespace tufted
