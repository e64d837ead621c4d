#pragma once

#include "base/parallel.h"
#include "base/point_buffer.h"
#include "denoise/windows.h"

namespace tufted {

/// Fits quadratics in the widest windows. These hold no neighbours but the middles of other windows, each moved onto
/// the quadratic of its own: a few of them say what many points do.
/// @param windows around every so many points, with the fits through neighbours; gets those through middles
void fitThroughMiddles(const PointsView& points, const Workers& workers, Windows& windows);

}  // namespace tufted
