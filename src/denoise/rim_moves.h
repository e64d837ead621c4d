#pragma once

#include "base/parallel.h"
#include "denoise/noise_level.h"
#include "denoise/window_choice.h"
#include "denoise/windows.h"

namespace tufted {

/// Moves points that noise along the surface has put beyond its rim back onto the rim, along the surface.
/// @param windows around every so many points
/// @param[in,out] move n x 3, onto the surface; points that stay are left alone
void moveOntoRims(const PointsView& points, const NeighborSource& source, const Windows& windows,
                  const NoiseLevel& noise, const WindowChoice& choice, const Workers& workers, PointBuffer& move);

}  // namespace tufted
