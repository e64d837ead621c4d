#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "stars/denoise.h"
#include "stars/neighborhood.h"
#include "stars/offsets.h"

namespace tufted {

/// Points that are noise around a surface, and the neighbours that say so.
struct NoisyPoints {
  Buffer<int> rank;
  Buffer<std::size_t> end;   ///< where the neighbours of each end in `neighbors`
  RawBuffer<int> neighbors;  ///< ranks
};

/// Memory that one worker reuses from group to group, whose fits are solved together.
struct FitScratch {
  static constexpr int most = NeighborhoodFinder::most_planes;
  std::array<HeightMoments, most> moments;
  std::array<HeightFit, most> fits;
};

/// Takes the offsets from p to its neighbours, all where they have been moved to. Moves may be far smaller than
/// positions are far from the origin: they are added to differences.
/// @param moved n x 3, how far each point has moved
void takeMoved(const PointsView& points, const PointBuffer& moved, int p, std::span<const int> neighbors,
               OffsetBuffer& offsets);

/// Moves points onto the surface through their neighbours if these are noise around one, and keeps them for a second
/// look.
/// @param moved RankedCloud::move; points that have moved stay where they are
/// @param first at most FitScratch::most points from here on
/// @param offsets of their neighbours
/// @param displacement n x 3, of which theirs are set
void displaceNoisyPoints(const PointBuffer& moved, int first, std::span<const Neighborhood> neighborhoods,
                         std::span<const OffsetBuffer> offsets, FitScratch& scratch, PointBuffer& displacement,
                         NoisyPoints& noisy);

/// Moves noisy points once more, onto the surface through the places that their neighbours have by now.
/// @param moved of all points, before any is moved once more
/// @param offsets scratch for FitScratch::most neighbourhoods
/// @param displacement `moved`, to which more is added
void displaceOnceMore(const PointsView& points, const PointBuffer& moved, const NoisyPoints& noisy,
                      const RawBuffer<double>& fit_radius, std::span<OffsetBuffer> offsets, FitScratch& scratch,
                      PointBuffer& displacement);

}  // namespace tufted
