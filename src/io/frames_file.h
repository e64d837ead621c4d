#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "io/output_file.h"
#include "tufted/laplacian.h"

namespace tufted::io {

/// N x 9: of each point the x axis, the y axis and the normal.
Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor> axesOf(const Frames& frames);

/// Writes them as N x 3 x 3, float64.
void writeFrames(const OutputPath& to, const Frames& frames);

/// @param status of the points
/// @throws IoError unless there is an orthonormal frame for each active point, or none at all
Frames readFrames(const std::filesystem::path& path, const std::vector<PointStatus>& status);

}  // namespace tufted::io
