#include "stars/neighborhood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/buffer.h"
#include "stars/stars.h"

namespace tufted {
namespace {

/// A neighbourhood grows to at most this many times k: rings with an anisotropy of 80 need that.
constexpr int most_growth = 8;
/// Factor on the expected squared radius of a larger neighbourhood, if points are spread evenly.
constexpr double more_likely = 1.2;
/// A larger share of the neighbours within half the radius is uneven; an evenly sampled surface has a quarter.
constexpr double crowd = 0.4;
constexpr int least_neighbors = 3;  // the least for a plane and a star

/// Planes per point: of the nearest 8, the nearest 13 and all.
constexpr std::size_t nested_sets = few_neighbors.size() + 1;

/// Covariances of the nearest few neighbours, if there are that many, and of all.
std::array<Covariance, nested_sets> nestedCovariances(const Offsets& neighbors, double radius) {
  std::array<int, nested_sets> ends;
  for (std::size_t j = 0; j < few_neighbors.size(); ++j) ends[j] = std::min(few_neighbors[j], neighbors.count);
  ends.back() = neighbors.count;
  std::array<Covariance, nested_sets> covariances;
  findCovariances(neighbors, radius, ends, covariances);
  return covariances;
}

/// Whether the nearest few are as thick as wide, as on a thin cable: more neighbours lie along it, seemingly on a line.
bool haveThickFew(Offsets neighbors) {
  neighbors.count = std::min(neighbors.count, few_neighbors[0]);
  return areThick(principalAxes(neighbors));
}

void takeAxes(std::size_t set, const PrincipalAxes& axes, Neighborhood& neighborhood) {
  (set < few_neighbors.size() ? neighborhood.axes_of_few[set] : neighborhood.axes) = axes;
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
    take(k, radius, neighborhood);
  } else {
    take(k, source_.nearest(points_, p, k, neighborhood.neighbors, NeighborOrder::ascending, &scratch.before),
         neighborhood);
  }
  source_.keepOwnSide(points_, p, neighborhood.neighbors);
  offsets.take(points_, p, neighborhood.neighbors);
  return true;
}

void NeighborhoodFinder::take(int k, double radius, Neighborhood& neighborhood) const {
  neighborhood.k = source_.isFixed() ? static_cast<int>(neighborhood.neighbors.size()) : k;
  neighborhood.radius = radius;
}

void NeighborhoodFinder::find(int first, int count, NeighborhoodScratch& scratch, Neighborhood* neighborhoods) const {
  if (source_.search != nullptr) source_.nearestOfEach(points_, first, count, scratch.batch, scratch.found);
  for (int i = 0; i < count; ++i) {
    Neighborhood& neighborhood = neighborhoods[i];
    if (source_.search != nullptr) {
      const auto k = static_cast<std::size_t>(source_.k);
      start(std::span<const Neighbor>(scratch.found).subspan(i * k, k), neighborhood);
      source_.keepOwnSide(points_, first + i, neighborhood.neighbors);
      continue;
    }
    neighborhood.grown = neighborhood.split = neighborhood.wrapped = neighborhood.restored = neighborhood.isolated =
        false;
    take(source_.k, source_.nearest(points_, first + i, source_.k, neighborhood.neighbors), neighborhood);
  }
}

void NeighborhoodFinder::start(std::span<const Neighbor> neighbors, Neighborhood& neighborhood) const {
  neighborhood.grown = neighborhood.split = neighborhood.wrapped = neighborhood.restored = neighborhood.isolated =
      false;
  neighborhood.neighbors.assign(neighbors.begin(), neighbors.end());
  take(static_cast<int>(neighbors.size()), neighbors.empty() ? 0 : std::sqrt(neighbors.back().squared_distance),
       neighborhood);
}

bool NeighborhoodFinder::isUneven(const Neighborhood& neighborhood) const {
  if (std::ssize(neighborhood.neighbors) < least_neighbors) return true;
  if (liesOnOneLine(neighborhood.axes)) return true;
  if (options_.steps.growth == Growth::line || source_.isGraded()) return false;
  const double half = neighborhood.radius / 2;
  const auto far = std::partition_point(neighborhood.neighbors.begin(), neighborhood.neighbors.end(),
                                        [half](const Neighbor& q) { return q.squared_distance <= half * half; });
  return static_cast<double>(far - neighborhood.neighbors.begin()) > crowd * neighborhood.k;
}

void NeighborhoodFinder::fitPlanes(std::span<Neighborhood> neighborhoods, std::span<const OffsetBuffer> offsets) const {
  std::array<std::array<Covariance, most_planes>, nested_sets> covariances;
  const std::size_t first_set = splitsSheets() ? 0 : few_neighbors.size();
  for (std::size_t i = 0; i < neighborhoods.size(); ++i) {
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
  neighborhood.thick = areThick(neighborhood.axes);
  neighborhood.cable = neighborhood.grown && haveThickFew(offsets.view());
  if (!splitsSheets()) return;
  if (neighborhood.grown) {  // the nearest few may have changed
    std::array<PrincipalAxes, nested_sets> axes;
    principalAxes(nestedCovariances(offsets.view(), neighborhood.radius), axes);
    for (std::size_t j = 0; j < nested_sets; ++j) takeAxes(j, axes[j], neighborhood);
  }
  splitSheets(neighborhood, offsets, scratch.sheets);
}

bool NeighborhoodFinder::grow(int p, int most, Neighborhood& neighborhood, OffsetBuffer& offsets,
                              NeighborhoodScratch& scratch) const {
  if (!query(p, std::min(2 * neighborhood.k, most), neighborhood, offsets, scratch)) return false;
  if (neighborhood.wrapped)
    leaveOutSteep(neighborhood.axes.normal, neighborhood, offsets, scratch.sheets);
  else if (splitsSheets() && (neighborhood.split || (!neighborhood.restored && !neighborhood.grown)))
    keepSheet(neighborhood.axes.normal, neighborhood, offsets, scratch.sheets);
  return true;
}

}  // namespace tufted
