#pragma once

#include <vector>

#include "io/conventions.h"
#include "io/output_file.h"
#include "tufted/laplacian.h"

namespace tufted::io {

/// Writes laplacian.mat as documented at writeLaplacian(), without compression.
/// @param L compressed
/// @throws IoError, also where a variable is larger than the format allows
void writeMat(const OutputPath& to, const SparseMatrix& L, const VectorXd& M, const Laplacian& laplacian,
              const std::vector<Convention>& conventions);

}  // namespace tufted::io
