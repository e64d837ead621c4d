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

/// The first few neighbours, or all where there are fewer.
std::span<const Neighbor> nearestOf(const Neighborhood& hood, std::size_t few) {
  return std::span(hood.neighbors).first(std::min(hood.neighbors.size(), few));
}

}  // namespace

bool NeighborhoodFinder::splitsSheets() const {
  return options_.steps.split_sheets && !source_.isFixed() && !source_.isGraded();
}

int NeighborhoodFinder::mostNeighbors() const {
  return most_growth * source_.k;
}

bool NeighborhoodFinder::query(int p, int k, Neighborhood& hood, HoodScratch& scratch) const {
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
      Offsets of_few;
      covariances[i] = covarianceOf(points_, first + i, nearestOf(hoods[i], few_neighbors[j]), of_few);
    }
    principalAxes(std::span(covariances).first(hoods.size()), axes);
    for (int i = 0; i < count; ++i) hoods[i].axes_of_few[j] = axes[i];
  }
}

void NeighborhoodFinder::refine(int p, Neighborhood& hood, HoodScratch& scratch) const {
  while (isUneven(hood) && query(p, std::min(2 * hood.k, mostNeighbors()), hood, scratch)) {
    hood.axes = principalAxes(points_, p, hood.neighbors);
    hood.grown = true;
  }
  hood.reach = hood.radius;
  if (!splitsSheets()) return;
  if (hood.grown) {  // a scan may know other ways to the nearest few by now
    for (std::size_t j = 0; j < few_neighbors.size(); ++j)
      hood.axes_of_few[j] = principalAxes(points_, p, nearestOf(hood, few_neighbors[j]));
  }
  splitSheets(p, hood, scratch);
}

bool NeighborhoodFinder::grow(int p, int most, Neighborhood& hood, HoodScratch& scratch) const {
  if (!query(p, std::min(2 * hood.k, most), hood, scratch)) return false;
  if (splitsSheets() && (hood.split || (!hood.restored && !hood.grown))) keepSheet(p, hood.axes.normal, hood, scratch);
  return true;
}

void SheetPositions::take(const PointsView& points, int p, std::span<const Neighbor> neighbors) {
  const auto room = static_cast<std::size_t>(toLanes(static_cast<int>(neighbors.size())));
  for (auto* axis : {&x, &y, &z}) axis->assign(room, 0);
  const double* const origin = points.row(p).data();
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    const double* const q = points.row(neighbors[i].index).data();
    x[i] = q[0] - origin[0];
    y[i] = q[1] - origin[1];
    z[i] = q[2] - origin[2];
  }
}

bool NeighborhoodFinder::keepSheet(int p, const Eigen::Vector3d& normal, Neighborhood& hood,
                                   HoodScratch& scratch) const {
  scratch.positions.take(points_, p, hood.neighbors);
  return keepSheet(scratch.positions, normal, hood, scratch);
}

bool NeighborhoodFinder::keepSheet(const SheetPositions& positions, const Eigen::Vector3d& normal, Neighborhood& hood,
                                   HoodScratch& scratch) const {
  if (hood.neighbors.empty()) return false;
  scratch.heights.resize(positions.x.size());
  const Reliefs reliefs{static_cast<int>(positions.x.size()), positions.x.data(), positions.y.data(),
                        positions.z.data(), scratch.heights.data()};
  const auto [lowest, highest, bottom, top] = kernels().reachHeights(reliefs, normal.data(), sheet_gap * hood.reach);
  if (lowest <= bottom && highest >= top) return false;
  if (scratch.all.empty()) scratch.all = hood.neighbors;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < hood.neighbors.size(); ++i)
    if (scratch.heights[i] >= lowest && scratch.heights[i] <= highest) hood.neighbors[kept++] = hood.neighbors[i];
  hood.neighbors.resize(kept);
  return true;
}

void NeighborhoodFinder::splitSheets(int p, Neighborhood& hood, HoodScratch& scratch) const {
  if (hood.neighbors.empty()) return;
  const PrincipalAxes before = hood.axes;
  scratch.all.clear();
  scratch.positions_of_all.take(points_, p, hood.neighbors);
  for (std::size_t j = 0; j < few_neighbors.size(); ++j) {
    if (hood.neighbors.size() <= few_neighbors[j]) break;
    const PrincipalAxes& axes = hood.axes_of_few[j];
    if (!(flatness(axes) < flatter[j] * flatness(before) && axes.variance[0] < 0.05 * axes.variance[1])) continue;
    if (!keepSheet(scratch.positions_of_all, axes.normal, hood, scratch)) continue;
    hood.axes = principalAxes(points_, p, hood.neighbors);
    break;
  }
  for (int i = 0; i < most_splits; ++i) {
    const bool is_cut = scratch.all.empty() ? keepSheet(scratch.positions_of_all, hood.axes.normal, hood, scratch)
                                            : keepSheet(p, hood.axes.normal, hood, scratch);
    if (!is_cut) break;
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

bool NeighborhoodFinder::findSheet(int p, const PrincipalAxes& before, Neighborhood& hood, HoodScratch& scratch) const {
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
      if (!keepSheet(scratch.positions_of_all, normal.normalized(), tried, scratch)) continue;
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
