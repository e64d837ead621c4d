#pragma once

#include <filesystem>

#include "tufted/types.h"

namespace tufted::io {

/// Writes a matrix as scipy.sparse.save_npz does (csc, int32 indices). The same matrix gives the same bytes.
/// @param path where the bytes go
/// @param shown the path to name in errors
/// @throws IoError
void writeNpz(const std::filesystem::path& path, const std::filesystem::path& shown, const SparseMatrix& matrix);

}  // namespace tufted::io
