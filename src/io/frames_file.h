#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "io/output_file.h"
#include "tufted/laplacian.h"

namespace tufted::io {

/// Names of the values of Orientation in report.json.
inline constexpr std::array<const char*, 4> orientation_names = {"arbitrary", "given", "viewpoint", "consistent"};

/// Frames as N x 9: the x axis, the y axis and the normal of each point.
Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor> axesOf(const Frames& frames);

/// Writes frames as N x 3 x 3, float64.
void writeFrames(const OutputPath& to, const Frames& frames);

/// Reads frames, a frame per point or none. Their orientation is not in the file and stays arbitrary.
/// @throws IoError for another number of frames
Frames readFrames(const std::filesystem::path& path, std::size_t points);

/// Checks that the frames of active points are orthonormal.
/// @throws IoError naming the first active point whose frame is not
void requireOrthonormal(const std::filesystem::path& path, const Frames& frames,
                        const std::vector<PointStatus>& status);

}  // namespace tufted::io
