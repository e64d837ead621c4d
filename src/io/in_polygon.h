#pragma once

#include <Eigen/Core>
#include <vector>

namespace tufted::io {

/// Whether a point lies on an edge of a closed polygon or inside it, by the rule of Selection::polygon.
/// @param corners with coordinates up to 1e150
bool isInside(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& point);

}  // namespace tufted::io
