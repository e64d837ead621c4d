#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "io/output_file.h"
#include "tufted/laplacian.h"

// The .npy files of a Laplacian.

namespace tufted::io {

inline constexpr const char* positions_name = "measured_positions.npy";
inline constexpr const char* component_edges_name = "component_edges.npy";
/// Names of the values of Orientation in report.json.
inline constexpr std::array<const char*, 4> orientation_names = {"arbitrary", "given", "viewpoint", "consistent"};

/// Writes a .npy file.
/// @param descr numpy's name of the type, such as "<f8"
/// @param shape in C order
void writeNpy(const OutputPath& to, std::string_view descr, const std::vector<std::int64_t>& shape, const void* values);

/// Frames as N x 9: the x axis, the y axis and the normal of each point.
Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor> axesOf(const Frames& frames);
/// Writes frames as N x 3 x 3, float64.
void writeFrames(const OutputPath& to, const Frames& frames);
/// Writes the edges of C components as C x 3, float64: number of sides, mean length and mean squared length.
void writeComponentEdges(const OutputPath& to, const std::vector<ComponentEdges>& edges);

/// Reads a value for each row of L. @throws IoError for another number of values, and for an array without numbers
std::vector<double> readValues(const std::filesystem::path& path, std::size_t points);
/// Reads frames, a frame per point or none. Their orientation is not in the file and stays arbitrary.
/// @throws IoError for another number of frames
Frames readFrames(const std::filesystem::path& path, std::size_t points);
/// Reads positions, one per point or none.
/// @throws IoError for another number of positions
Points readPositions(const std::filesystem::path& path, std::size_t points);
/// Reads Laplacian::noise, a value per point or none.
/// @throws IoError for another number of values, or one that is negative or not finite
VectorXd readNoise(const std::filesystem::path& path, std::size_t points);
/// Reads the edges of components, one entry per component or none.
/// @throws IoError for another number of rows, or numbers that no edges can have
std::vector<ComponentEdges> readComponentEdges(const std::filesystem::path& path, std::size_t components);

/// Checks that the frames of active points are orthonormal.
/// @throws IoError naming the first active point whose frame is not
void requireOrthonormal(const std::filesystem::path& path, const Frames& frames,
                        const std::vector<PointStatus>& status);
/// Checks that active points have finite positions.
/// @param positions N x 3 or 0 x 3
/// @throws IoError naming the first active point whose position is not finite
void requireFinite(const std::filesystem::path& path, const Points& positions, const std::vector<PointStatus>& status);

}  // namespace tufted::io
