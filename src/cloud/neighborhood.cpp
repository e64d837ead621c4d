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

constexpr int most_growth = 8;      // a neighbourhood grows to at most 8 k
constexpr double crowd = 0.4;       // of the neighbours within half the radius; on an even surface it is a quarter
constexpr double sheet_gap = 0.25;  // of the reach, between the heights of two sheets
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

/// How far one comes from 0, in the direction of `sign`, over gaps of at most `gap` between the heights, the farthest
/// of which lies at `end`. Each round goes as far as one gap reaches, and two go farther than that: there are few.
double farthestReached(const Buffer<double>& heights, double sign, double gap, double end) {
  double reached = 0;
  while (end - reached > gap) {
    double next = reached;
    for (const double height : heights) {
      const double ahead = sign * height;
      next = ahead - reached <= gap && ahead > next ? ahead : next;
    }
    if (next == reached) return reached;
    reached = next;
  }
  return end;
}

}  // namespace

bool NeighborhoodFinder::splitsSheets() const {
  return options_.steps.split_sheets && !source_.isFixed() && !source_.isGraded();
}

int NeighborhoodFinder::mostNeighbors() const {
  return most_growth * source_.k;
}

bool NeighborhoodFinder::query(int p, int k, Neighborhood& hood, SheetScratch& scratch) const {
  k = std::min(k, static_cast<int>(points_.rows()) - 1);
  if (source_.isFixed() || k <= hood.k) return false;
  search(p, k, hood, &scratch.before);
  return true;
}

void NeighborhoodFinder::search(int p, int k, Neighborhood& hood, SearchBefore* before) const {
  const ScanSearch::Searched searched =
      source_.nearest(points_, p, k, hood.neighbors, NeighborOrder::ascending, before);
  hood.k = source_.isFixed() ? static_cast<int>(hood.neighbors.size()) : k;
  hood.radius = searched.radius;
  hood.cut = searched.cut;
}

void NeighborhoodFinder::find(int first, int count, GroupScratch& scratch, Buffer<Neighbor>& found,
                              Neighborhood* hoods) const {
  if (source_.search != nullptr) source_.nearestOfEach(points_, first, count, scratch, found);
  for (int i = 0; i < count; ++i) {
    Neighborhood& hood = hoods[i];
    hood.grown = hood.split = hood.restored = hood.isolated = false;
    if (source_.search == nullptr) {
      search(first + i, source_.k, hood, nullptr);
      continue;
    }
    const auto row = found.begin() + static_cast<std::ptrdiff_t>(i) * source_.k;
    hood.neighbors.assign(row, row + source_.k);
    hood.k = source_.k;
    hood.radius = source_.k > 0 ? std::sqrt(hood.neighbors.back().squared_distance) : 0;
    hood.cut = 0;
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

void NeighborhoodFinder::fitPlanes(int first, std::span<Neighborhood> hoods, std::span<Offsets> offsets) const {
  std::array<Covariance, most_planes> covariances;
  std::array<PrincipalAxes, most_planes> axes;
  const auto count = static_cast<int>(hoods.size());
  for (int i = 0; i < count; ++i) covariances[i] = covarianceOf(points_, first + i, hoods[i].neighbors, offsets[i]);
  principalAxes(std::span(covariances).first(hoods.size()), axes);
  for (int i = 0; i < count; ++i) hoods[i].axes = axes[i];
  if (!splitsSheets()) return;
  for (std::size_t j = 0; j < few_neighbors.size(); ++j) {
    for (int i = 0; i < count; ++i) {
      const std::span<const Neighbor> all = hoods[i].neighbors;
      Offsets of_few;
      covariances[i] = covarianceOf(points_, first + i, all.first(std::min(all.size(), few_neighbors[j])), of_few);
    }
    principalAxes(std::span(covariances).first(hoods.size()), axes);
    for (int i = 0; i < count; ++i) hoods[i].axes_of_few[j] = axes[i];
  }
}

void NeighborhoodFinder::refine(int p, Neighborhood& hood, SheetScratch& scratch) const {
  while (isUneven(hood) && query(p, std::min(2 * hood.k, mostNeighbors()), hood, scratch)) {
    hood.axes = principalAxes(points_, p, hood.neighbors);
    hood.grown = true;
  }
  hood.reach = hood.radius;
  if (splitsSheets()) splitSheets(p, hood, scratch);
}

bool NeighborhoodFinder::grow(int p, int most, Neighborhood& hood, SheetScratch& scratch) const {
  if (!query(p, std::min(2 * hood.k, most), hood, scratch)) return false;
  if (splitsSheets() && (hood.split || (!hood.restored && !hood.grown))) keepSheet(p, hood.axes.normal, hood, scratch);
  return true;
}

bool NeighborhoodFinder::keepSheet(int p, const Eigen::Vector3d& normal, Neighborhood& hood,
                                   SheetScratch& scratch) const {
  if (hood.neighbors.empty()) return false;
  const double gap = sheet_gap * hood.reach;
  const double* const origin = points_.row(p).data();
  scratch.heights.resize(hood.neighbors.size());
  double top = 0, bottom = 0;
  for (std::size_t i = 0; i < hood.neighbors.size(); ++i) {
    const double* const q = points_.row(hood.neighbors[i].index).data();
    const double height =
        (q[0] - origin[0]) * normal[0] + ((q[1] - origin[1]) * normal[1] + (q[2] - origin[2]) * normal[2]);
    scratch.heights[i] = height;
    top = std::max(top, height);
    bottom = std::min(bottom, height);
  }
  const double highest = farthestReached(scratch.heights, 1, gap, top);
  const double lowest = -farthestReached(scratch.heights, -1, gap, -bottom);
  if (lowest <= bottom && highest >= top) return false;
  if (scratch.all.empty()) scratch.all = hood.neighbors;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < hood.neighbors.size(); ++i)
    if (scratch.heights[i] >= lowest && scratch.heights[i] <= highest) hood.neighbors[kept++] = hood.neighbors[i];
  hood.neighbors.resize(kept);
  return true;
}

void NeighborhoodFinder::splitSheets(int p, Neighborhood& hood, SheetScratch& scratch) const {
  if (hood.neighbors.empty()) return;
  const PrincipalAxes before = hood.axes;
  scratch.all.clear();
  for (std::size_t j = 0; j < few_neighbors.size(); ++j) {
    if (hood.neighbors.size() <= few_neighbors[j]) break;
    const PrincipalAxes& axes = hood.axes_of_few[j];
    if (!(flatness(axes) < flatter[j] * flatness(before) && axes.variance[0] < 0.05 * axes.variance[1])) continue;
    if (!keepSheet(p, axes.normal, hood, scratch)) continue;
    hood.axes = principalAxes(points_, p, hood.neighbors);
    break;
  }
  for (int i = 0; i < most_splits; ++i) {
    if (!keepSheet(p, hood.axes.normal, hood, scratch)) break;
    hood.axes = principalAxes(points_, p, hood.neighbors);
  }
  if (scratch.all.empty()) {
    hood.split = flatness(before) > flat_sheet && findSheet(p, before, hood, scratch);
  } else if (hood.neighbors.size() + 1 <= least_sheet) {
    hood.isolated = true;
  } else if (isSheet(hood, before, flat_sheet) || findSheet(p, before, hood, scratch)) {
    hood.split = true;
  } else {
    hood.restored = true;
  }
}

bool NeighborhoodFinder::findSheet(int p, const PrincipalAxes& before, Neighborhood& hood,
                                   SheetScratch& scratch) const {
  if (scratch.all.empty()) scratch.all = hood.neighbors;
  Neighborhood& tried = scratch.tried;
  tried = hood;
  hood.neighbors.clear();
  const std::size_t corners = std::min(scratch.all.size(), most_corners);
  for (std::size_t i = 1; i < corners; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Eigen::Vector3d u = points_.row(scratch.all[i].index) - points_.row(p);
      const Eigen::Vector3d v = points_.row(scratch.all[j].index) - points_.row(p);
      const Eigen::Vector3d normal = u.cross(v);
      if (!(normal.norm() > least_sine * u.norm() * v.norm())) continue;
      tried.neighbors = scratch.all;
      if (!keepSheet(p, normal.normalized(), tried, scratch)) continue;
      tried.axes = principalAxes(points_, p, tried.neighbors);
      if (keepSheet(p, tried.axes.normal, tried, scratch)) tried.axes = principalAxes(points_, p, tried.neighbors);
      if (!isSheet(tried, before, flat_few) || tried.neighbors.size() <= hood.neighbors.size()) continue;
      hood.neighbors.swap(tried.neighbors);
      hood.axes = tried.axes;
    }
  }
  if (!hood.neighbors.empty()) return true;
  hood.neighbors = scratch.all;
  hood.axes = before;
  return false;
}

}  // namespace tufted
