#pragma once

#include <Eigen/Core>
#include <array>

#include "base/buffer.h"
#include "stars/offsets.h"
#include "stars/tangent_frame.h"

namespace tufted {

struct Neighborhood;

/// Heights farther apart than this part of the fit radius belong to two sheets: sheets at 4 spacings are told apart,
/// and a surface curved within its neighbourhood is not cut.
constexpr double sheet_gap = 0.25;

/// Some of the neighbours of a point, reached from it along planes.
struct TriedSheet {
  OffsetBuffer offsets;
  Eigen::Vector3d first_normal;   ///< of the plane through p and two neighbours that they were reached along
  Eigen::Vector3d second_normal;  ///< of the plane through these, which they were cut along once more
  PrincipalAxes axes;             ///< of what is left
};

/// Memory that one worker reuses from point to point.
struct SheetScratch {
  Buffer<Neighbor> all;  ///< the neighbours before any were left out; empty while none were
  OffsetBuffer offsets_of_all;
  Buffer<double> heights;
  HeightRange range;             ///< of the heights that are reached from p
  Buffer<double> heights_along;  ///< see Kernels::connectedHeightsAlong
  /// Pairs of four neighbours.
  static constexpr int most_tried = 6;
  std::array<TriedSheet, most_tried> tried;
};

/// Whether all heights are connected with 0.
inline bool isWhole(const HeightRange& range) {
  return range.lowest <= range.bottom && range.highest >= range.top;
}

/// Keeps the neighbours whose heights along `normal` are reached from p over gaps of at most a quarter of the fit
/// radius. Returns whether some were left out.
bool keepSheet(const Eigen::Vector3d& normal, Neighborhood& neighborhood, OffsetBuffer& offsets, SheetScratch& scratch);

/// Leaves out the neighbours of other sheets, that is, of surfaces that pass by at a distance. Says in the
/// neighbourhood what came of it, and fits its plane to those that are left. Where these are no plane, all are kept.
/// @param neighborhood has planes fitted to all of its neighbours and to the first few
/// @param offsets of the neighbours, before and after
void splitSheets(Neighborhood& neighborhood, OffsetBuffer& offsets, SheetScratch& scratch);

}  // namespace tufted
