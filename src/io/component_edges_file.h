#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "io/output_file.h"
#include "tufted/laplacian.h"

namespace tufted::io {

inline constexpr const char* component_edges_name = "component_edges.npy";

/// Writes the edges of C components as C x 3, float64: number of sides, mean length and mean squared length.
void writeComponentEdges(const OutputPath& to, const std::vector<ComponentEdges>& edges);

/// Reads the edges of components.
/// @return one entry per component, or none
/// @throws IoError for another number of rows, or numbers that no edges can have
std::vector<ComponentEdges> readComponentEdges(const std::filesystem::path& path, std::size_t components);

}  // namespace tufted::io
