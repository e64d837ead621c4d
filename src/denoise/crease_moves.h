#pragma once

#include <span>

#include "denoise/neighbor_lists.h"
#include "denoise/noise_level.h"
#include "denoise/window_choice.h"
#include "denoise/windows.h"

namespace tufted {

/// Where no window around a point is free of a bend, as next to a crease: moves it onto the faces that meet there, each
/// of which ends at the crease. Where no such faces explain the points, onto the surface of windows around other points
/// that hold it, and then onto a fit through those neighbours alone whose surface has its normal. Outliers that belong
/// to the faces around them move as well.
/// @param lists the neighbours of all points that may be moved
/// @param windows around every point
/// @param which points that may be moved
/// @param around these, and all others in windows of these
/// @param normals n x 3, of the surface around each of these; overwritten where a point moves so
/// @param move n x 3, of all points by their own windows; overwritten where a point moves so
/// @returns n, 1 where a point moves so
Buffer<std::uint8_t> moveNextToCreases(const PointsView& points, const NeighborLists& lists, const Windows& windows,
                                       const NoiseLevel& noise, const WindowChoice& choice, std::span<const int> which,
                                       std::span<const int> around, const Workers& workers, PointBuffer& normals,
                                       PointBuffer& move);

}  // namespace tufted
