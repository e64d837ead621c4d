#pragma once

#include <vector>

#include "io/conventions.h"
#include "io/output_file.h"
#include "tufted/types.h"

namespace tufted::io {

/// Writes the lower triangle of a symmetric matrix as Matrix Market (https://math.nist.gov/MatrixMarket/formats.html).
/// @throws IoError
void writeMtx(const OutputPath& to, const SparseMatrix& matrix, const std::vector<Convention>& conventions);
/// Writes an N x 1 array as Matrix Market.
/// @throws IoError
void writeMtx(const OutputPath& to, const VectorXd& values, const std::vector<Convention>& conventions);

/// Writes lines `row column value`, counted from 1, column by column and without a header, as the paper's program does.
/// The last diagonal entry is written even if it is 0, because readers take the size from the largest indices.
/// @throws IoError
void writeSpmat(const OutputPath& to, const SparseMatrix& matrix);
/// Writes the diagonal matrix of `values` in the same way, zeros included.
/// @throws IoError
void writeSpmat(const OutputPath& to, const VectorXd& values);

}  // namespace tufted::io
