#include "stars/neighborhood.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/buffer.h"
#include "stars/stars.h"

namespace tufted {
namespace {

constexpr int most_growth = 8;       // a neighbourhood grows to at most 8 k
constexpr double more_likely = 1.2;  // times the square that holds more neighbours where they are spread evenly
constexpr double crowd = 0.4;        // of the neighbours within half the radius; on an even surface it is a quarter
constexpr double sheet_gap = 0.25;   // of the reach, between the heights of two sheets
constexpr std::array<double, few_neighbors.size()> flatter = {0.1, 0.5};  // than all, planes of few
constexpr int most_splits = 3;
constexpr int least_sheet = 3, least_plane = 9;      // points, p included
constexpr double flat_sheet = 0.1, flat_few = 0.05;  // of the second variance; found by many, by two neighbours
constexpr int most_corners = 4;                      // of the triangles at p whose planes a sheet is sought along
constexpr double least_sine = 0.3;                   // of their angles at p

double flatness(const PrincipalAxes& axes) {
  return axes.variance[1] > 0 ? axes.variance[0] / axes.variance[1] : 0;
}

/// Whether what is left of a neighbourhood is a plane, as flat as asked and far flatter than it was.
bool isSheet(int neighbors, const PrincipalAxes& axes, const PrincipalAxes& before, double flat) {
  return neighbors + 1 >= least_plane && !liesOnOneLine(axes) && flatness(axes) < flat &&
         flatness(axes) < 0.25 * flatness(before);
}

constexpr std::size_t nested_sets = few_neighbors.size() + 1;

/// Of the first few neighbours, or all where there are fewer, then of all.
std::array<Covariance, nested_sets> nestedCovariances(const Offsets& neighbors, double radius) {
  std::array<int, nested_sets> ends;
  for (std::size_t j = 0; j < few_neighbors.size(); ++j) ends[j] = std::min(few_neighbors[j], neighbors.count);
  ends.back() = neighbors.count;
  std::array<Covariance, nested_sets> covariances;
  findCovariances(neighbors, radius, ends, covariances);
  return covariances;
}

void takeAxes(std::size_t set, const PrincipalAxes& axes, Neighborhood& hood) {
  (set < few_neighbors.size() ? hood.axes_of_few[set] : hood.axes) = axes;
}

/// Keeps all neighbours as they are before the first are left out.
void saveAll(const Neighborhood& hood, const OffsetBuffer& offsets, HoodScratch& scratch) {
  if (!scratch.all.empty()) return;
  scratch.all = hood.neighbors;
  scratch.offsets_of_all = offsets;
}

bool isWhole(const Reached& reached) {
  return reached.lowest <= reached.bottom && reached.highest >= reached.top;
}

/// Whether all neighbours are reached from p, along `normal`, over gaps of at most a quarter of the reach. Leaves their
/// heights, and which of them are.
bool isOneSheet(const Offsets& neighbors, const Eigen::Vector3d& normal, double reach, HoodScratch& scratch) {
  scratch.heights.resize(static_cast<std::size_t>(toLanes(neighbors.count)));
  scratch.sheet = kernels().reachHeights(neighbors, normal.data(), sheet_gap * reach, scratch.heights.data());
  return isWhole(scratch.sheet);
}

/// Those of the neighbours last looked at that are reached.
void takeSheet(const HoodScratch& scratch, Neighborhood& hood, OffsetBuffer& offsets) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < hood.neighbors.size(); ++i) {
    hood.neighbors[kept] = hood.neighbors[i];
    kept += scratch.heights[i] >= scratch.sheet.lowest && scratch.heights[i] <= scratch.sheet.highest ? 1 : 0;
  }
  hood.neighbors.resize(kept);
  offsets.takeReached(offsets, scratch.heights.data(), scratch.sheet);
}

}  // namespace

bool NeighborhoodFinder::splitsSheets() const {
  return options_.steps.split_sheets && !source_.isFixed() && !source_.isGraded() &&
         !source_.isWholeCloud(points_.rows());
}

int NeighborhoodFinder::mostNeighbors() const {
  return most_growth * source_.k;
}

bool NeighborhoodFinder::query(int p, int k, Neighborhood& hood, OffsetBuffer& offsets, HoodScratch& scratch) const {
  k = std::min(k, static_cast<int>(points_.rows()) - 1);
  if (source_.isFixed() || k <= hood.k) return false;
  const double likely = more_likely * k / hood.k * hood.radius * hood.radius;
  if (source_.search != nullptr &&
      nearestOfKnown(*source_.search, points_, p, k, likely, kernels(), scratch.group, hood.neighbors)) {
    const double radius = std::sqrt(hood.neighbors.back().squared_distance);
    scratch.before = {p, k, radius};
    take(k, {radius, 0}, hood);
  } else {
    take(k, source_.nearest(points_, p, k, hood.neighbors, NeighborOrder::ascending, &scratch.before), hood);
  }
  offsets.take(points_, p, hood.neighbors);
  return true;
}

void NeighborhoodFinder::take(int k, const ScanSearch::Searched& searched, Neighborhood& hood) const {
  hood.k = source_.isFixed() ? static_cast<int>(hood.neighbors.size()) : k;
  hood.radius = searched.radius;
  hood.cut = searched.cut;
}

void NeighborhoodFinder::find(int first, int count, HoodScratch& scratch, Neighborhood* hoods) const {
  if (source_.search != nullptr) source_.nearestOfEach(points_, first, count, scratch.group, scratch.found);
  for (int i = 0; i < count; ++i) {
    Neighborhood& hood = hoods[i];
    hood.grown = hood.split = hood.restored = hood.isolated = false;
    if (source_.search == nullptr) {
      take(source_.k, source_.nearest(points_, first + i, source_.k, hood.neighbors), hood);
      continue;
    }
    const auto row = scratch.found.begin() + static_cast<std::ptrdiff_t>(i) * source_.k;
    hood.neighbors.assign(row, row + source_.k);
    take(source_.k, {source_.k > 0 ? std::sqrt(hood.neighbors.back().squared_distance) : 0, 0}, hood);
  }
}

bool NeighborhoodFinder::isUneven(const Neighborhood& hood) const {
  if (std::ssize(hood.neighbors) < least_sheet) return true;
  if (liesOnOneLine(hood.axes)) return true;
  if (options_.steps.growth == Growth::line || source_.isGraded()) return false;
  const double half = hood.radius / 2;
  const auto far = std::partition_point(hood.neighbors.begin(), hood.neighbors.end(),
                                        [half](const Neighbor& q) { return q.squared_distance <= half * half; });
  return static_cast<double>(far - hood.neighbors.begin()) > crowd * hood.k;
}

void NeighborhoodFinder::fitPlanes(int first, std::span<Neighborhood> hoods, std::span<OffsetBuffer> offsets) const {
  std::array<std::array<Covariance, most_planes>, nested_sets> covariances;
  const std::size_t first_set = splitsSheets() ? 0 : few_neighbors.size();
  for (std::size_t i = 0; i < hoods.size(); ++i) {
    offsets[i].take(points_, first + static_cast<int>(i), hoods[i].neighbors);
    if (!splitsSheets()) {
      covariances.back()[i] = covarianceOf(offsets[i].view(), hoods[i].radius);
      continue;
    }
    const auto nested = nestedCovariances(offsets[i].view(), hoods[i].radius);
    for (std::size_t j = 0; j < nested_sets; ++j) covariances[j][i] = nested[j];
  }
  for (std::size_t j = first_set; j < nested_sets; ++j) {
    std::array<PrincipalAxes, most_planes> axes;
    principalAxes(std::span(covariances[j]).first(hoods.size()), axes);
    for (std::size_t i = 0; i < hoods.size(); ++i) takeAxes(j, axes[i], hoods[i]);
  }
}

void NeighborhoodFinder::refine(int p, Neighborhood& hood, OffsetBuffer& offsets, HoodScratch& scratch) const {
  while (isUneven(hood) && query(p, std::min(2 * hood.k, mostNeighbors()), hood, offsets, scratch)) {
    hood.axes = principalAxes(offsets.view());
    hood.grown = true;
  }
  hood.reach = hood.radius;
  if (!splitsSheets()) return;
  if (hood.grown) {  // a scan may know other ways to the nearest few by now
    std::array<PrincipalAxes, nested_sets> axes;
    principalAxes(nestedCovariances(offsets.view(), hood.radius), axes);
    for (std::size_t j = 0; j < nested_sets; ++j) takeAxes(j, axes[j], hood);
  }
  splitSheets(hood, offsets, scratch);
}

bool NeighborhoodFinder::grow(int p, int most, Neighborhood& hood, OffsetBuffer& offsets, HoodScratch& scratch) const {
  if (!query(p, std::min(2 * hood.k, most), hood, offsets, scratch)) return false;
  if (splitsSheets() && (hood.split || (!hood.restored && !hood.grown)))
    keepSheet(hood.axes.normal, hood, offsets, scratch);
  return true;
}

bool NeighborhoodFinder::keepSheet(const Eigen::Vector3d& normal, Neighborhood& hood, OffsetBuffer& offsets,
                                   HoodScratch& scratch, bool saves_all) const {
  if (hood.neighbors.empty() || isOneSheet(offsets.view(), normal, hood.reach, scratch)) return false;
  if (saves_all) saveAll(hood, offsets, scratch);
  takeSheet(scratch, hood, offsets);
  return true;
}

void NeighborhoodFinder::splitSheets(Neighborhood& hood, OffsetBuffer& offsets, HoodScratch& scratch) const {
  if (hood.neighbors.empty()) return;
  const PrincipalAxes before = hood.axes;
  scratch.all.clear();
  for (std::size_t j = 0; j < few_neighbors.size(); ++j) {
    if (std::ssize(hood.neighbors) <= few_neighbors[j]) break;
    const PrincipalAxes& axes = hood.axes_of_few[j];
    if (!(flatness(axes) < flatter[j] * flatness(before) && axes.variance[0] < 0.05 * axes.variance[1])) continue;
    if (!keepSheet(axes.normal, hood, offsets, scratch, true)) continue;
    hood.axes = principalAxes(offsets.view());
    break;
  }
  for (int i = 0; i < most_splits && keepSheet(hood.axes.normal, hood, offsets, scratch, true); ++i)
    hood.axes = principalAxes(offsets.view());
  if (scratch.all.empty()) {
    hood.split = flatness(before) > flat_sheet && findSheet(before, hood, offsets, scratch);
  } else if (std::ssize(hood.neighbors) + 1 <= least_sheet) {
    hood.isolated = true;
  } else if (isSheet(static_cast<int>(hood.neighbors.size()), hood.axes, before, flat_sheet) ||
             findSheet(before, hood, offsets, scratch)) {
    hood.split = true;
  } else {
    hood.restored = true;
  }
}

bool NeighborhoodFinder::findSheet(const PrincipalAxes& before, Neighborhood& hood, OffsetBuffer& offsets,
                                   HoodScratch& scratch) const {
  const bool is_cut = !scratch.all.empty();
  const OffsetBuffer& all = is_cut ? scratch.offsets_of_all : offsets;
  const Offsets corners = all.view();
  const auto corner = [&corners](int i) { return Eigen::Vector3d(corners.x[i], corners.y[i], corners.z[i]); };
  Normals planes{};
  std::size_t plane_count = 0;
  for (int i = 1; i < std::min(corners.count, most_corners); ++i) {
    for (int j = 0; j < i; ++j) {
      const Eigen::Vector3d u = corner(i), v = corner(j), normal = u.cross(v);
      const double length = normal.norm();
      if (!(length > least_sine * u.norm() * v.norm())) continue;
      planes.x[plane_count] = normal.x() / length;
      planes.y[plane_count] = normal.y() / length;
      planes.z[plane_count++] = normal.z() / length;
    }
  }
  std::array<Reached, kernel_lane> reached;
  scratch.heights.resize(static_cast<std::size_t>(toLanes(corners.count)));
  scratch.heights_along.resize(static_cast<std::size_t>(kernel_lane * corners.count));
  kernels().reachAlong(corners, planes, sheet_gap * hood.reach, scratch.heights_along.data(), reached.data());
  std::array<Eigen::Vector3d, HoodScratch::most_tried> normals;
  std::size_t count = 0;
  for (std::size_t i = 0; i < plane_count; ++i) {
    if (isWhole(reached[i])) continue;
    for (int j = 0; j < corners.count; ++j) scratch.heights[j] = scratch.heights_along[kernel_lane * j + i];
    scratch.tried[count].takeReached(all, scratch.heights.data(), reached[i]);
    if (scratch.tried[count].count() + 1 < least_plane) continue;
    normals[count++] = {planes.x[i], planes.y[i], planes.z[i]};
  }

  // What a plane through three points reaches has a plane of its own, along which it is cut once more.
  std::array<Covariance, HoodScratch::most_tried> covariances;
  std::array<PrincipalAxes, HoodScratch::most_tried> first_axes, axes;
  for (std::size_t i = 0; i < count; ++i) covariances[i] = covarianceOf(scratch.tried[i].view(), hood.radius);
  principalAxes(std::span(covariances).first(count), first_axes);
  std::array<std::size_t, HoodScratch::most_tried> cut;
  std::size_t cut_count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    OffsetBuffer& tried = scratch.tried[i];
    if (isOneSheet(tried.view(), first_axes[i].normal, hood.reach, scratch)) continue;
    tried.takeReached(tried, scratch.heights.data(), scratch.sheet);
    covariances[cut_count] = covarianceOf(tried.view(), hood.radius);
    cut[cut_count++] = i;
  }
  std::array<PrincipalAxes, HoodScratch::most_tried> cut_axes;
  principalAxes(std::span(covariances).first(cut_count), cut_axes);
  axes = first_axes;
  for (std::size_t i = 0; i < cut_count; ++i) axes[cut[i]] = cut_axes[i];

  std::size_t best = count;
  for (std::size_t i = 0; i < count; ++i) {
    const int size = scratch.tried[i].count();
    if (isSheet(size, axes[i], before, flat_few) && (best == count || size > scratch.tried[best].count())) best = i;
  }
  if (is_cut) {
    hood.neighbors = scratch.all;
    offsets = scratch.offsets_of_all;
    hood.axes = before;
  }
  if (best == count) return false;
  keepSheet(normals[best], hood, offsets, scratch);
  keepSheet(first_axes[best].normal, hood, offsets, scratch);
  hood.axes = axes[best];
  return true;
}

}  // namespace tufted
