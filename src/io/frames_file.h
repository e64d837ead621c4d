#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "io/output_file.h"
#include "tufted/laplacian.h"

namespace tufted::io {

/// The name of each Orientation in report.json, by number.
inline constexpr std::array<const char*, 4> orientation_names = {"arbitrary", "given", "viewpoint", "consistent"};

/// Frames as N x 9: the x axis, the y axis and the normal of each point.
Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor> axesOf(const Frames& frames);

/// Writes frames as N x 3 x 3, float64.
void writeFrames(const OutputPath& to, const Frames& frames);

/// Reads frames, whose orientation the file does not say.
/// @throws IoError unless there is a frame for each point, or none at all
Frames readFrames(const std::filesystem::path& path, std::size_t points);

/// Checks that the frames of active points are orthonormal.
/// @param status of the points
/// @throws IoError naming the first active point whose frame is not orthonormal
void requireOrthonormal(const std::filesystem::path& path, const Frames& frames,
                        const std::vector<PointStatus>& status);

}  // namespace tufted::io
