#pragma once

#include <Eigen/Core>
#include <array>

#include "base/buffer.h"
#include "stars/offsets.h"
#include "stars/tangent_frame.h"

namespace tufted {

struct Neighborhood;

/// Heights farther apart than this share of the fit radius belong to two sheets: sheets 4 spacings apart are separated,
/// and a surface curved within its neighbourhood is not cut.
constexpr double sheet_gap = 0.25;

/// Neighbours of a point that remain after cuts along two planes.
struct TriedSheet {
  OffsetBuffer offsets;
  Eigen::Vector3d first_normal;   ///< of the plane through p and two neighbours, along which the first cut was made
  Eigen::Vector3d second_normal;  ///< of the plane fitted to the rest, along which the second cut was made
  PrincipalAxes axes;             ///< of the points after both cuts
};

/// Memory that one worker reuses from point to point.
struct SheetScratch {
  Buffer<Neighbor> all;  ///< all neighbours before the first cut; empty without a cut
  OffsetBuffer offsets_of_all;
  Buffer<double> heights;
  HeightRange range;             ///< of the heights that are reached from p
  Buffer<double> heights_along;  ///< see Kernels::connectedHeightsAlong
  /// Number of pairs of four neighbours.
  static constexpr int most_tried = 6;
  std::array<TriedSheet, most_tried> tried;
};

/// Whether the range contains all heights.
inline bool isWhole(const HeightRange& range) {
  return range.lowest <= range.bottom && range.highest >= range.top;
}

/// Keeps the neighbours whose heights along `normal` are reached from p over gaps of at most a quarter of the fit
/// radius. Returns whether any were removed.
bool keepSheet(const Eigen::Vector3d& normal, Neighborhood& neighborhood, OffsetBuffer& offsets, SheetScratch& scratch);

/// Leaves out the neighbours that lie steeply over or under p, as those around the bend of a cable do.
void leaveOutSteep(const Eigen::Vector3d& normal, Neighborhood& neighborhood, OffsetBuffer& offsets,
                   SheetScratch& scratch);

/// Removes neighbours on other sheets, surfaces that pass nearby (section 4 of docs/algorithm.md), and fits the plane
/// to the rest; `split`, `wrapped`, `isolated` or `restored` record the outcome. If the rest is no plane, all are kept.
/// @param neighborhood has planes fitted to all of its neighbours and to the nearest few
/// @param offsets of the neighbours, before and after
void splitSheets(Neighborhood& neighborhood, OffsetBuffer& offsets, SheetScratch& scratch);

}  // namespace tufted
