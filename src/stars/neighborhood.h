#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "neighbors/neighbor_source.h"
#include "stars/offsets.h"
#include "stars/sheets.h"
#include "stars/tangent_frame.h"
#include "tufted/options.h"

namespace tufted {

/// Planes are also fitted to this many nearest neighbours: between two sheets the plane of all stands across them, that
/// of the nearest few mostly does not. Not varied since the first design.
constexpr std::array<int, 2> few_neighbors = {8, 13};

/// The neighbours of one point and the plane through them (sections 3 and 4 of docs/algorithm.md).
struct Neighborhood {
  Buffer<Neighbor> neighbors;  ///< by ascending distance; without those on other sheets
  PrincipalAxes axes;
  /// of the nearest few_neighbors, if there are more neighbours
  std::array<PrincipalAxes, few_neighbors.size()> axes_of_few;
  int k = 0;              ///< number of neighbours that were searched
  double radius = 0;      ///< radius of the ball that was searched
  double fit_radius = 0;  ///< `radius` when the plane was fitted, S(p)
  bool grown = false;     ///< whether more than the caller's k neighbours were taken for the plane
  bool split = false;     ///< whether neighbours on another sheet were removed
  bool restored = false;  ///< whether all were kept because the rest was no plane
  bool thick = false;     ///< whether all neighbours were as thick as wide
  bool cable = false;     ///< whether the nearest few were as thick as wide, and more of them lay along a line
  bool wrapped = false;   ///< whether steep neighbours were left out, as the neighbourhood reaches around a thin part
  bool isolated = false;  ///< whether nearly all neighbours belong to other sheets
};

/// Memory that one worker reuses from point to point.
struct NeighborhoodScratch {
  BatchScratch batch;
  Buffer<Neighbor> found;
  SheetScratch sheets;
  SearchBefore before;
};

/// Finds the neighbourhoods of points and fits their planes.
class NeighborhoodFinder {
 public:
  /// All arguments are borrowed.
  NeighborhoodFinder(const PointsView& points, const NeighborSource& source, const CloudOptions& options)
      : points_(points), source_(source), options_(options) {}

  /// The k neighbours of each point of [first, first + count), or the caller's lists. More neighbours of these points,
  /// with the same scratch, are then fast to find.
  void find(int first, int count, NeighborhoodScratch& scratch, Neighborhood* neighborhoods) const;

  /// Sets the neighbours of a neighbourhood, by ascending distance.
  void start(std::span<const Neighbor> neighbors, Neighborhood& neighborhood) const;

  /// Number of planes that are fitted at once: two packets.
  static constexpr int most_planes = 16;
  /// Fits planes to at most most_planes neighbourhoods, and to the nearest few of each if sheets are split.
  /// @param offsets of the neighbours, at least one buffer per neighbourhood
  void fitPlanes(std::span<Neighborhood> neighborhoods, std::span<const OffsetBuffer> offsets) const;

  /// Doubles the neighbourhood and fits its plane anew while it is uneven or a line, then splits sheets.
  /// @param offsets of the neighbours, before and after
  void refine(int p, Neighborhood& neighborhood, OffsetBuffer& offsets, NeighborhoodScratch& scratch) const;

  /// Doubles the number of neighbours, up to `most`, without those on other sheets and sides; the plane does not
  /// change. Returns false if there are no more neighbours.
  /// @param offsets of the neighbours, before and after
  bool grow(int p, int most, Neighborhood& neighborhood, OffsetBuffer& offsets, NeighborhoodScratch& scratch) const;

  /// The greatest number of neighbours that refine() takes.
  int mostNeighbors() const;

 private:
  void take(int k, double radius, Neighborhood& neighborhood) const;
  /// Searches k neighbours; false if there are no more than before.
  bool query(int p, int k, Neighborhood& neighborhood, OffsetBuffer& offsets, NeighborhoodScratch& scratch) const;
  /// Not on rings and in small clouds, where other rings and the far side would be taken for sheets.
  bool splitsSheets() const;
  bool isUneven(const Neighborhood& neighborhood) const;

  PointsView points_;
  const NeighborSource& source_;
  const CloudOptions& options_;
};

}  // namespace tufted
