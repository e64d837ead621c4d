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
constexpr double sheet_gap = 0.25;   // of the fit radius, between the heights of two sheets
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

/// The numbers of neighbours that planes are fitted to: the first few, if there are so many, then all.
std::array<Covariance, nested_sets> nestedCovariances(const Offsets& neighbors, double radius) {
  std::array<int, nested_sets> ends;
  for (std::size_t j = 0; j < few_neighbors.size(); ++j) ends[j] = std::min(few_neighbors[j], neighbors.count);
  ends.back() = neighbors.count;
  std::array<Covariance, nested_sets> covariances;
  findCovariances(neighbors, radius, ends, covariances);
  return covariances;
}

void takeAxes(std::size_t set, const PrincipalAxes& axes, Neighborhood& neighborhood) {
  (set < few_neighbors.size() ? neighborhood.axes_of_few[set] : neighborhood.axes) = axes;
}

/// Keeps all neighbours as they are before the first are left out.
void saveAll(const Neighborhood& neighborhood, const OffsetBuffer& offsets, NeighborhoodScratch& scratch) {
  if (!scratch.all.empty()) return;
  scratch.all = neighborhood.neighbors;
  scratch.offsets_of_all = offsets;
}

bool isWhole(const HeightRange& range) {
  return range.lowest <= range.bottom && range.highest >= range.top;
}

/// Whether all neighbours are reached from p, along `normal`, over gaps of at most a quarter of the fit radius. Leaves
/// their heights, and which of them are.
bool isOneSheet(const Offsets& neighbors, const Eigen::Vector3d& normal, double fit_radius,
                NeighborhoodScratch& scratch) {
  scratch.heights.resize(static_cast<std::size_t>(toPackets(neighbors.count)));
  scratch.sheet = kernels().connectedHeights(neighbors, normal.data(), sheet_gap * fit_radius, scratch.heights.data());
  return isWhole(scratch.sheet);
}

/// Keeps the neighbours last looked at whose heights are in the range.
void takeSheet(const NeighborhoodScratch& scratch, Neighborhood& neighborhood, OffsetBuffer& offsets) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < neighborhood.neighbors.size(); ++i) {
    neighborhood.neighbors[kept] = neighborhood.neighbors[i];
    kept += scratch.heights[i] >= scratch.sheet.lowest && scratch.heights[i] <= scratch.sheet.highest ? 1 : 0;
  }
  neighborhood.neighbors.resize(kept);
  offsets.takeConnected(offsets, scratch.heights.data(), scratch.sheet);
}

}  // namespace

bool NeighborhoodFinder::splitsSheets() const {
  return options_.steps.split_sheets && !source_.isFixed() && !source_.isGraded() &&
         !source_.isWholeCloud(points_.rows());
}

int NeighborhoodFinder::mostNeighbors() const {
  return most_growth * source_.k;
}

bool NeighborhoodFinder::query(int p, int k, Neighborhood& neighborhood, OffsetBuffer& offsets,
                               NeighborhoodScratch& scratch) const {
  k = std::min(k, static_cast<int>(points_.rows()) - 1);
  if (source_.isFixed() || k <= neighborhood.k) return false;
  const double likely = more_likely * k / neighborhood.k * neighborhood.radius * neighborhood.radius;
  if (source_.search != nullptr &&
      nearestOfKnown(*source_.search, points_, p, k, likely, kernels(), scratch.batch, neighborhood.neighbors)) {
    const double radius = std::sqrt(neighborhood.neighbors.back().squared_distance);
    scratch.before = {p, k, radius};
    take(k, {radius, 0}, neighborhood);
  } else {
    take(k, source_.nearest(points_, p, k, neighborhood.neighbors, NeighborOrder::ascending, &scratch.before),
         neighborhood);
  }
  offsets.take(points_, p, neighborhood.neighbors);
  return true;
}

void NeighborhoodFinder::take(int k, const ScanSearch::Searched& searched, Neighborhood& neighborhood) const {
  neighborhood.k = source_.isFixed() ? static_cast<int>(neighborhood.neighbors.size()) : k;
  neighborhood.radius = searched.radius;
  neighborhood.cut = searched.cut;
}

void NeighborhoodFinder::find(int first, int count, NeighborhoodScratch& scratch, Neighborhood* neighborhoods) const {
  if (source_.search != nullptr) source_.nearestOfEach(points_, first, count, scratch.batch, scratch.found);
  for (int i = 0; i < count; ++i) {
    Neighborhood& neighborhood = neighborhoods[i];
    neighborhood.grown = neighborhood.split = neighborhood.restored = neighborhood.isolated = false;
    if (source_.search == nullptr) {
      take(source_.k, source_.nearest(points_, first + i, source_.k, neighborhood.neighbors), neighborhood);
      continue;
    }
    const auto row = scratch.found.begin() + static_cast<std::ptrdiff_t>(i) * source_.k;
    neighborhood.neighbors.assign(row, row + source_.k);
    take(source_.k, {source_.k > 0 ? std::sqrt(neighborhood.neighbors.back().squared_distance) : 0, 0}, neighborhood);
  }
}

bool NeighborhoodFinder::isUneven(const Neighborhood& neighborhood) const {
  if (std::ssize(neighborhood.neighbors) < least_sheet) return true;
  if (liesOnOneLine(neighborhood.axes)) return true;
  if (options_.steps.growth == Growth::line || source_.isGraded()) return false;
  const double half = neighborhood.radius / 2;
  const auto far = std::partition_point(neighborhood.neighbors.begin(), neighborhood.neighbors.end(),
                                        [half](const Neighbor& q) { return q.squared_distance <= half * half; });
  return static_cast<double>(far - neighborhood.neighbors.begin()) > crowd * neighborhood.k;
}

void NeighborhoodFinder::fitPlanes(int first, std::span<Neighborhood> neighborhoods,
                                   std::span<OffsetBuffer> offsets) const {
  std::array<std::array<Covariance, most_planes>, nested_sets> covariances;
  const std::size_t first_set = splitsSheets() ? 0 : few_neighbors.size();
  for (std::size_t i = 0; i < neighborhoods.size(); ++i) {
    offsets[i].take(points_, first + static_cast<int>(i), neighborhoods[i].neighbors);
    if (!splitsSheets()) {
      covariances.back()[i] = covarianceOf(offsets[i].view(), neighborhoods[i].radius);
      continue;
    }
    const auto nested = nestedCovariances(offsets[i].view(), neighborhoods[i].radius);
    for (std::size_t j = 0; j < nested_sets; ++j) covariances[j][i] = nested[j];
  }
  for (std::size_t j = first_set; j < nested_sets; ++j) {
    std::array<PrincipalAxes, most_planes> axes;
    principalAxes(std::span(covariances[j]).first(neighborhoods.size()), axes);
    for (std::size_t i = 0; i < neighborhoods.size(); ++i) takeAxes(j, axes[i], neighborhoods[i]);
  }
}

void NeighborhoodFinder::refine(int p, Neighborhood& neighborhood, OffsetBuffer& offsets,
                                NeighborhoodScratch& scratch) const {
  while (isUneven(neighborhood) &&
         query(p, std::min(2 * neighborhood.k, mostNeighbors()), neighborhood, offsets, scratch)) {
    neighborhood.axes = principalAxes(offsets.view());
    neighborhood.grown = true;
  }
  neighborhood.fit_radius = neighborhood.radius;
  if (!splitsSheets()) return;
  if (neighborhood.grown) {  // a scan may know other ways to the nearest few by now
    std::array<PrincipalAxes, nested_sets> axes;
    principalAxes(nestedCovariances(offsets.view(), neighborhood.radius), axes);
    for (std::size_t j = 0; j < nested_sets; ++j) takeAxes(j, axes[j], neighborhood);
  }
  splitSheets(neighborhood, offsets, scratch);
}

bool NeighborhoodFinder::grow(int p, int most, Neighborhood& neighborhood, OffsetBuffer& offsets,
                              NeighborhoodScratch& scratch) const {
  if (!query(p, std::min(2 * neighborhood.k, most), neighborhood, offsets, scratch)) return false;
  if (splitsSheets() && (neighborhood.split || (!neighborhood.restored && !neighborhood.grown)))
    keepSheet(neighborhood.axes.normal, neighborhood, offsets, scratch);
  return true;
}

bool NeighborhoodFinder::keepSheet(const Eigen::Vector3d& normal, Neighborhood& neighborhood, OffsetBuffer& offsets,
                                   NeighborhoodScratch& scratch, bool saves_all) const {
  if (neighborhood.neighbors.empty() || isOneSheet(offsets.view(), normal, neighborhood.fit_radius, scratch))
    return false;
  if (saves_all) saveAll(neighborhood, offsets, scratch);
  takeSheet(scratch, neighborhood, offsets);
  return true;
}

void NeighborhoodFinder::splitSheets(Neighborhood& neighborhood, OffsetBuffer& offsets,
                                     NeighborhoodScratch& scratch) const {
  if (neighborhood.neighbors.empty()) return;
  const PrincipalAxes before = neighborhood.axes;
  scratch.all.clear();
  for (std::size_t j = 0; j < few_neighbors.size(); ++j) {
    if (std::ssize(neighborhood.neighbors) <= few_neighbors[j]) break;
    const PrincipalAxes& axes = neighborhood.axes_of_few[j];
    if (!(flatness(axes) < flatter[j] * flatness(before) && axes.variance[0] < 0.05 * axes.variance[1])) continue;
    if (!keepSheet(axes.normal, neighborhood, offsets, scratch, true)) continue;
    neighborhood.axes = principalAxes(offsets.view());
    break;
  }
  for (int i = 0; i < most_splits && keepSheet(neighborhood.axes.normal, neighborhood, offsets, scratch, true); ++i)
    neighborhood.axes = principalAxes(offsets.view());
  if (scratch.all.empty()) {
    neighborhood.split = flatness(before) > flat_sheet && findSheet(before, neighborhood, offsets, scratch);
  } else if (std::ssize(neighborhood.neighbors) + 1 <= least_sheet) {
    neighborhood.isolated = true;
  } else if (isSheet(static_cast<int>(neighborhood.neighbors.size()), neighborhood.axes, before, flat_sheet) ||
             findSheet(before, neighborhood, offsets, scratch)) {
    neighborhood.split = true;
  } else {
    neighborhood.restored = true;
  }
}

bool NeighborhoodFinder::findSheet(const PrincipalAxes& before, Neighborhood& neighborhood, OffsetBuffer& offsets,
                                   NeighborhoodScratch& scratch) const {
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
  std::array<HeightRange, kernel_packet> range;
  scratch.heights.resize(static_cast<std::size_t>(toPackets(corners.count)));
  scratch.heights_along.resize(static_cast<std::size_t>(kernel_packet * corners.count));
  kernels().connectedHeightsAlong(corners, planes, sheet_gap * neighborhood.fit_radius, scratch.heights_along.data(),
                                  range.data());
  std::array<Eigen::Vector3d, NeighborhoodScratch::most_tried> normals;
  std::size_t count = 0;
  for (std::size_t i = 0; i < plane_count; ++i) {
    if (isWhole(range[i])) continue;
    for (int j = 0; j < corners.count; ++j) scratch.heights[j] = scratch.heights_along[kernel_packet * j + i];
    scratch.tried[count].takeConnected(all, scratch.heights.data(), range[i]);
    if (scratch.tried[count].count() + 1 < least_plane) continue;
    normals[count++] = {planes.x[i], planes.y[i], planes.z[i]};
  }

  // What a plane through three points reaches has a plane of its own, along which it is cut once more.
  std::array<Covariance, NeighborhoodScratch::most_tried> covariances;
  std::array<PrincipalAxes, NeighborhoodScratch::most_tried> first_axes, axes;
  for (std::size_t i = 0; i < count; ++i) covariances[i] = covarianceOf(scratch.tried[i].view(), neighborhood.radius);
  principalAxes(std::span(covariances).first(count), first_axes);
  std::array<std::size_t, NeighborhoodScratch::most_tried> cut;
  std::size_t cut_count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    OffsetBuffer& tried = scratch.tried[i];
    if (isOneSheet(tried.view(), first_axes[i].normal, neighborhood.fit_radius, scratch)) continue;
    tried.takeConnected(tried, scratch.heights.data(), scratch.sheet);
    covariances[cut_count] = covarianceOf(tried.view(), neighborhood.radius);
    cut[cut_count++] = i;
  }
  std::array<PrincipalAxes, NeighborhoodScratch::most_tried> cut_axes;
  principalAxes(std::span(covariances).first(cut_count), cut_axes);
  axes = first_axes;
  for (std::size_t i = 0; i < cut_count; ++i) axes[cut[i]] = cut_axes[i];

  std::size_t best = count;
  for (std::size_t i = 0; i < count; ++i) {
    const int size = scratch.tried[i].count();
    if (isSheet(size, axes[i], before, flat_few) && (best == count || size > scratch.tried[best].count())) best = i;
  }
  if (is_cut) {
    neighborhood.neighbors = scratch.all;
    offsets = scratch.offsets_of_all;
    neighborhood.axes = before;
  }
  if (best == count) return false;
  keepSheet(normals[best], neighborhood, offsets, scratch);
  keepSheet(first_axes[best].normal, neighborhood, offsets, scratch);
  neighborhood.axes = axes[best];
  return true;
}

}  // namespace tufted
