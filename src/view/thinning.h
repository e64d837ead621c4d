#pragma once

#include <vector>

#include "tufted/view/scene.h"

namespace tufted::view {

/// Chooses `most` finite points of a larger cloud evenly along the Morton curve, so that dense and sparse parts are
/// thinned alike, and all sources of distances.
/// @return ascending indices; empty if all points are kept: of meshes, of at most `most` points, or if `most` is 0
std::vector<int> thinned(const Scene& scene, Eigen::Index most);

/// The scene of some points of a cloud.
Scene sceneOfRows(const Scene& scene, const std::vector<int>& rows);

}  // namespace tufted::view
