#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "cloud/neighbor_source.h"
#include "cloud/tangent_frame.h"
#include "tufted/options.h"

namespace tufted {

/// Between two sheets the plane of all neighbours stands across them; that of the nearest few does not.
constexpr std::array<std::size_t, 2> few_neighbors = {8, 13};

/// The neighbours of one point and the plane through them.
struct Neighborhood {
  Buffer<Neighbor> neighbors;  ///< ascending; those of other sheets left out
  PrincipalAxes axes;
  std::array<PrincipalAxes, few_neighbors.size()> axes_of_few;  ///< of the first few, where there are more of them
  std::int64_t cut = 0;                                         ///< left out because the surface jumps in between
  int k = 0;                                                    ///< neighbours asked for
  double radius = 0;                                            ///< distance to the last of them
  double reach = 0;                                             ///< the radius that the plane was fitted in, S(p)
  bool grown = false;                                           ///< the plane was fitted to more than the caller's k
  bool split = false;                                           ///< neighbours of another sheet were left out
  bool restored = false;                                        ///< there were some, but without them there is no plane
  bool isolated = false;                                        ///< next to all neighbours belong to other sheets
};

/// Neighbours relative to their point, filled up to whole lanes with zeros.
struct SheetPositions {
  Buffer<double> x, y, z;

  void take(const PointsView& points, int p, std::span<const Neighbor> neighbors);
};

/// Memory that one worker reuses from point to point.
struct HoodScratch {
  GroupScratch group;
  Buffer<Neighbor> found;
  SheetPositions positions, positions_of_all;
  Buffer<double> heights;
  Buffer<Neighbor> all;  ///< before any were left out; empty while none were
  Neighborhood tried;
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
  void find(int first, int count, HoodScratch& scratch, Neighborhood* hoods) const;

  static constexpr int most_planes = 16;
  /// Fits planes to at most most_planes neighbourhoods of points from `first` on, and to the first few of each where
  /// sheets are split.
  /// @param[out] offsets of the neighbours of each, if they are at most Offsets::most; until refine() has them grow or
  /// splits them
  void fitPlanes(int first, std::span<Neighborhood> hoods, std::span<Offsets> offsets) const;

  /// Doubles the neighbourhood while it says too little about the surface, with a plane fitted anew, and leaves other
  /// sheets out.
  void refine(int p, Neighborhood& hood, HoodScratch& scratch) const;

  /// Asks for twice as many neighbours, at most `most`; other sheets are left out as before, the plane stays as it is.
  /// False when there are no more to be had.
  bool grow(int p, int most, Neighborhood& hood, HoodScratch& scratch) const;

  /// The most neighbours that refine() asks for.
  int mostNeighbors() const;

 private:
  void take(int k, const ScanSearch::Searched& searched, Neighborhood& hood) const;
  bool query(int p, int k, Neighborhood& hood, HoodScratch& scratch) const;
  /// Rings would be taken for sheets.
  bool splitsSheets() const;
  bool isUneven(const Neighborhood& hood) const;
  /// Keeps the neighbours whose heights along `normal` are reached from p over gaps of at most a quarter of the reach.
  /// True if some were left out.
  bool keepSheet(int p, const Eigen::Vector3d& normal, Neighborhood& hood, HoodScratch& scratch) const;
  /// @param positions of these neighbours
  bool keepSheet(const SheetPositions& positions, const Eigen::Vector3d& normal, Neighborhood& hood,
                 HoodScratch& scratch) const;
  void splitSheets(int p, Neighborhood& hood, HoodScratch& scratch) const;
  /// For where the planes of several neighbours stand across two sheets: the largest sheet along a plane through p and
  /// two of the nearest four. False, and the neighbourhood as it was before any were left out, if there is none.
  bool findSheet(int p, const PrincipalAxes& before, Neighborhood& hood, HoodScratch& scratch) const;

  PointsView points_;
  const NeighborSource& source_;
  const CloudOptions& options_;
};

}  // namespace tufted
