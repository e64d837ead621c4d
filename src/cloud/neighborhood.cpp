#include "cloud/neighborhood.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/buffer.h"
#include "cloud/stars.h"

namespace tufted {
namespace {

constexpr int most_growth = 8;       // a neighbourhood grows to at most 8 k
constexpr double more_likely = 1.2;  // times the square that holds more neighbours where they are spread evenly
constexpr double crowd = 0.4;        // of the neighbours within half the radius; on an even surface it is a quarter
constexpr double sheet_gap = 0.25;   // of the reach, between the heights of two sheets
constexpr std::array<double, few_neighbors.size()> flatter = {0.1, 0.5};  // than all, planes of few
constexpr int most_splits = 3;
constexpr std::size_t least_sheet = 3, least_plane = 9;  // points, p included
constexpr double flat_sheet = 0.1, flat_few = 0.05;      // of the second variance; found by many, by two neighbours
constexpr std::size_t most_corners = 4;                  // of the triangles at p whose planes a sheet is sought along
constexpr double least_sine = 0.3;                       // of their angles at p

double flatness(const PrincipalAxes& axes) {
  return axes.variance[1] > 0 ? axes.variance[0] / axes.variance[1] : 0;
}

/// Whether what is left of a neighbourhood is a plane, as flat as asked and far flatter than it was.
bool isSheet(const Neighborhood& hood, const PrincipalAxes& before, double flat) {
  return hood.neighbors.size() + 1 >= least_plane && !liesOnOneLine(hood.axes) && flatness(hood.axes) < flat &&
         flatness(hood.axes) < 0.25 * flatness(before);
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

/// Whether all neighbours are reached from p, along `normal`, over gaps of at most a quarter of the reach. Leaves their
/// heights, and which of them are.
bool isOneSheet(const Offsets& neighbors, const Eigen::Vector3d& normal, double reach, HoodScratch& scratch) {
  scratch.heights.resize(static_cast<std::size_t>(toLanes(neighbors.count)));
  scratch.sheet = kernels().reachHeights(neighbors, normal.data(), sheet_gap * reach, scratch.heights.data());
  return scratch.sheet.lowest <= scratch.sheet.bottom && scratch.sheet.highest >= scratch.sheet.top;
}

bool isReached(std::size_t i, const HoodScratch& scratch) {
  return scratch.heights[i] >= scratch.sheet.lowest && scratch.heights[i] <= scratch.sheet.highest;
}

/// How many of the `count` neighbours last looked at are reached.
std::size_t countReached(std::size_t count, const HoodScratch& scratch) {
  std::size_t reached = 0;
  for (std::size_t i = 0; i < count; ++i) reached += isReached(i, scratch) ? 1 : 0;
  return reached;
}

/// Those of them that are.
/// @param[out] sheet, offsets_of_sheet may be the neighbours themselves
void takeSheet(const Buffer<Neighbor>& neighbors, const OffsetBuffer& offsets, const HoodScratch& scratch,
               Buffer<Neighbor>& sheet, OffsetBuffer& offsets_of_sheet) {
  offsets_of_sheet.takeKept(offsets, [&scratch](std::size_t i) { return isReached(i, scratch); });
  sheet.resize(neighbors.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    sheet[kept] = neighbors[i];
    kept += isReached(i, scratch) ? 1 : 0;
  }
  sheet.resize(kept);
}

}  // namespace

bool NeighborhoodFinder::splitsSheets() const {
  return options_.steps.split_sheets && !source_.isFixed() && !source_.isGraded();
}

int NeighborhoodFinder::mostNeighbors() const {
  return most_growth * source_.k;
}

bool NeighborhoodFinder::query(int p, int k, Neighborhood& hood, OffsetBuffer& offsets, HoodScratch& scratch) const {
  k = std::min(k, static_cast<int>(points_.rows()) - 1);
  if (source_.isFixed() || k <= hood.k) return false;
  const double likely = more_likely * k / hood.k * hood.radius * hood.radius;
  if (source_.search != nullptr && nearestOfKnown(points_, p, k, likely, kernels(), scratch.group, hood.neighbors)) {
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
  if (hood.neighbors.size() < least_sheet) return true;
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
  splitSheets(p, hood, offsets, scratch);
}

bool NeighborhoodFinder::grow(int p, int most, Neighborhood& hood, OffsetBuffer& offsets, HoodScratch& scratch) const {
  if (!query(p, std::min(2 * hood.k, most), hood, offsets, scratch)) return false;
  if (splitsSheets() && (hood.split || (!hood.restored && !hood.grown)))
    keepSheet(hood.axes.normal, hood, offsets, scratch);
  return true;
}

bool NeighborhoodFinder::keepSheet(const Eigen::Vector3d& normal, Neighborhood& hood, OffsetBuffer& offsets,
                                   HoodScratch& scratch) const {
  if (hood.neighbors.empty() || isOneSheet(offsets.view(), normal, hood.reach, scratch)) return false;
  saveAll(hood, offsets, scratch);
  takeSheet(hood.neighbors, offsets, scratch, hood.neighbors, offsets);
  return true;
}

void NeighborhoodFinder::splitSheets(int p, Neighborhood& hood, OffsetBuffer& offsets, HoodScratch& scratch) const {
  if (hood.neighbors.empty()) return;
  const PrincipalAxes before = hood.axes;
  scratch.all.clear();
  for (std::size_t j = 0; j < few_neighbors.size(); ++j) {
    if (std::ssize(hood.neighbors) <= few_neighbors[j]) break;
    const PrincipalAxes& axes = hood.axes_of_few[j];
    if (!(flatness(axes) < flatter[j] * flatness(before) && axes.variance[0] < 0.05 * axes.variance[1])) continue;
    if (!keepSheet(axes.normal, hood, offsets, scratch)) continue;
    hood.axes = principalAxes(offsets.view());
    break;
  }
  for (int i = 0; i < most_splits && keepSheet(hood.axes.normal, hood, offsets, scratch); ++i)
    hood.axes = principalAxes(offsets.view());
  if (scratch.all.empty()) {
    hood.split = flatness(before) > flat_sheet && findSheet(p, before, hood, offsets, scratch);
  } else if (hood.neighbors.size() + 1 <= least_sheet) {
    hood.isolated = true;
  } else if (isSheet(hood, before, flat_sheet) || findSheet(p, before, hood, offsets, scratch)) {
    hood.split = true;
  } else {
    hood.restored = true;
  }
}

bool NeighborhoodFinder::findSheet(int p, const PrincipalAxes& before, Neighborhood& hood, OffsetBuffer& offsets,
                                   HoodScratch& scratch) const {
  saveAll(hood, offsets, scratch);
  Neighborhood& tried = scratch.tried;
  OffsetBuffer& offsets_of_tried = scratch.offsets_of_tried;
  tried = hood;
  hood.neighbors.clear();
  const std::size_t corners = std::min(scratch.all.size(), most_corners);
  for (std::size_t i = 1; i < corners; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Eigen::Vector3d u = points_.row(scratch.all[i].index) - points_.row(p);
      const Eigen::Vector3d v = points_.row(scratch.all[j].index) - points_.row(p);
      const Eigen::Vector3d normal = u.cross(v);
      if (!(normal.norm() > least_sine * u.norm() * v.norm())) continue;
      if (isOneSheet(scratch.offsets_of_all.view(), normal.normalized(), hood.reach, scratch)) continue;
      const std::size_t reached = countReached(scratch.all.size(), scratch);  // which the second cut makes fewer
      if (reached + 1 < least_plane || reached <= hood.neighbors.size()) continue;
      takeSheet(scratch.all, scratch.offsets_of_all, scratch, tried.neighbors, offsets_of_tried);
      tried.axes = principalAxes(offsets_of_tried.view());
      if (keepSheet(tried.axes.normal, tried, offsets_of_tried, scratch))
        tried.axes = principalAxes(offsets_of_tried.view());
      if (!isSheet(tried, before, flat_few) || tried.neighbors.size() <= hood.neighbors.size()) continue;
      hood.neighbors.swap(tried.neighbors);
      std::swap(offsets, offsets_of_tried);
      hood.axes = tried.axes;
    }
  }
  if (!hood.neighbors.empty()) return true;
  hood.neighbors = scratch.all;
  offsets = scratch.offsets_of_all;
  hood.axes = before;
  return false;
}

}  // namespace tufted
