#pragma once

#include "io/output_file.h"
#include "tufted/types.h"

namespace tufted::io {

/// Writes a matrix as scipy.sparse.save_npz does (csc, int32 indices). The same matrix gives the same bytes.
/// @param matrix compressed
/// @throws IoError
void writeNpz(const OutputPath& to, const SparseMatrix& matrix);

}  // namespace tufted::io
