#pragma once

#include <filesystem>

#include "io/output_file.h"
#include "tufted/intrinsic_triangulation.h"

namespace tufted::io {

/// Writes cover.npz: faces (F x 3, int32), glue (F x 3, int32) and length (F x 3, float64).
void writeCover(const OutputPath& to, const IntrinsicTriangulation& cover);

/// Reads cover.npz.
/// @param vertices number of points of the Laplacian
/// @throws IoError for a file that is not a closed, oriented triangulation of these points whose lengths satisfy the
/// triangle inequality
IntrinsicTriangulation readCover(const std::filesystem::path& path, int vertices);

}  // namespace tufted::io
