#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "io/output_file.h"
#include "tufted/laplacian.h"

namespace tufted::io {

inline constexpr const char* positions_name = "measured_positions.npy";

/// Writes Laplacian::positions as N x 3, float64.
void writePositions(const OutputPath& to, const Points& positions);

/// Reads positions, one per point or none.
/// @throws IoError for another number of positions
Points readPositions(const std::filesystem::path& path, std::size_t points);

/// Checks that active points have finite positions.
/// @param positions N x 3 or 0 x 3
/// @throws IoError naming the first active point whose position is not finite
void requireFinite(const std::filesystem::path& path, const Points& positions, const std::vector<PointStatus>& status);

}  // namespace tufted::io
