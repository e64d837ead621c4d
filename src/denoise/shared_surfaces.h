#pragma once

#include "base/parallel.h"
#include "denoise/noise_level.h"
#include "denoise/window_choice.h"
#include "denoise/windows.h"

namespace tufted {

/// What windows around every so many points say about all points.
struct SharedSurfaces {
  Buffer<std::uint8_t> settled;  ///< n, 1 where they say how the point moves, or that it stays
  Buffer<int> nearest;           ///< n, the window whose middle is nearest, of those that hold the point
};

/// Moves points onto the mean of the surfaces of windows around other points, each weighted by how near the middle of
/// the window is: where the surface is smooth for windows of 64 neighbours and more, and where it bends within these
/// but has no crease, those of 32 around more points.
/// @param lists neighbours of the windows
/// @param windows around every so many points
/// @param[out] move n x 3; 0 where a point stays or is not settled
/// @param[out] variance n, that of the noise, of settled points that move
SharedSurfaces shareSurfaces(const PointsView& points, const NeighborSource& source, const NeighborLists& lists,
                             const Windows& windows, const NoiseLevel& noise, const WindowChoice& choice,
                             const Workers& workers, PointBuffer& move, RawBuffer<double>& variance);

}  // namespace tufted
