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

/// Between two sheets the plane of all neighbours stands across them; that of the nearest few mostly does not. Not
/// varied since the first design.
constexpr std::array<int, 2> few_neighbors = {8, 13};

/// The neighbours of one point and the plane through them.
struct Neighborhood {
  Buffer<Neighbor> neighbors;  ///< ascending; those of other sheets left out
  PrincipalAxes axes;
  std::array<PrincipalAxes, few_neighbors.size()> axes_of_few;  ///< of the first few, where there are more of them
  int k = 0;                                                    ///< neighbours asked for
  double radius = 0;                                            ///< distance to the last of them
  double fit_radius = 0;                                        ///< the radius that the plane was fitted in, S(p)
  bool grown = false;                                           ///< the plane was fitted to more than the caller's k
  bool split = false;                                           ///< neighbours of another sheet were left out
  bool restored = false;                                        ///< there were some, but without them there is no plane
  bool isolated = false;                                        ///< next to all neighbours belong to other sheets
};

/// Memory that one worker reuses from point to point.
struct NeighborhoodScratch {
  BatchScratch batch;
  Buffer<Neighbor> found;
  SheetScratch sheets;
  SearchBefore before;
};

/// Finds the neighbourhoods of points and fits planes to them.
class NeighborhoodFinder {
 public:
  /// All arguments are borrowed.
  NeighborhoodFinder(const PointsView& points, const NeighborSource& source, const CloudOptions& options)
      : points_(points), source_(source), options_(options) {}

  /// For each of `count` points from `first` on the caller's k neighbours, or the caller's own list. What is asked of
  /// these points later with the same scratch takes least time.
  void find(int first, int count, NeighborhoodScratch& scratch, Neighborhood* neighborhoods) const;

  /// Begins with neighbours that were found elsewhere, ascending.
  void start(std::span<const Neighbor> neighbors, Neighborhood& neighborhood) const;

  /// Planes that are fitted together, two packets.
  static constexpr int most_planes = 16;
  /// Fits planes to at most most_planes neighbourhoods, and to the first few of each where sheets are split.
  /// @param offsets of the neighbours of each; there may be more
  void fitPlanes(std::span<Neighborhood> neighborhoods, std::span<const OffsetBuffer> offsets) const;

  /// Doubles the neighbourhood while it says too little about the surface, with a plane fitted anew, and leaves other
  /// sheets out.
  /// @param offsets of the neighbours, before and after
  void refine(int p, Neighborhood& neighborhood, OffsetBuffer& offsets, NeighborhoodScratch& scratch) const;

  /// Asks for twice as many neighbours, at most `most`; other sheets are left out as before, the plane stays as it is.
  /// False when there are no more to be had.
  /// @param offsets of the neighbours, before and after
  bool grow(int p, int most, Neighborhood& neighborhood, OffsetBuffer& offsets, NeighborhoodScratch& scratch) const;

  /// The most neighbours that refine() asks for.
  int mostNeighbors() const;

 private:
  void take(int k, double radius, Neighborhood& neighborhood) const;
  bool query(int p, int k, Neighborhood& neighborhood, OffsetBuffer& offsets, NeighborhoodScratch& scratch) const;
  /// Rings, and the far side of a small cloud, would be taken for sheets.
  bool splitsSheets() const;
  bool isUneven(const Neighborhood& neighborhood) const;

  PointsView points_;
  const NeighborSource& source_;
  const CloudOptions& options_;
};

}  // namespace tufted
