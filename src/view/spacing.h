#pragma once

#include <vector>

#include "view/projection.h"

namespace tufted::view {

/// For each point the radius of a disc that, together with its neighbours', leaves no hole in the surface; at most a
/// share of the scene, and not much more than others have, so that a point far from all others is a dot.
/// @returns N radii in the coordinates of `points`
std::vector<float> discRadii(const NormalizedPoints& points, int threads);

}  // namespace tufted::view
