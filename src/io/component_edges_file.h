#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "io/output_file.h"
#include "tufted/laplacian.h"

namespace tufted::io {

inline constexpr const char* component_edges_name = "component_edges.npy";

/// Writes the edges of C components as C x 3, float64: how many sides, their mean length, their mean squared length.
void writeComponentEdges(const OutputPath& to, const std::vector<ComponentEdges>& edges);

/// Reads the edges of components.
/// @param components how many there are
/// @throws IoError unless there are edges for each component, or for none at all, with numbers that edges have
std::vector<ComponentEdges> readComponentEdges(const std::filesystem::path& path, std::size_t components);

}  // namespace tufted::io
