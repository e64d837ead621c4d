#pragma once

#include <vector>

#include "io/conventions.h"
#include "io/output_file.h"
#include "tufted/types.h"

namespace tufted::io {

/// Matrix Market: the lower triangle of a symmetric matrix (https://math.nist.gov/MatrixMarket/formats.html).
/// @throws IoError, as do the others
void writeMtx(const OutputPath& to, const SparseMatrix& matrix, const std::vector<Convention>& conventions);
/// Matrix Market: an N x 1 array.
void writeMtx(const OutputPath& to, const VectorXd& values, const std::vector<Convention>& conventions);

/// Triplets counted from 1, column by column, without a header, as the paper's program writes them. A matrix whose last
/// diagonal entry is not stored gets it as 0, because readers take the size from the largest indices.
void writeSpmat(const OutputPath& to, const SparseMatrix& matrix);
/// The same for the diagonal matrix of `values`, zeros included.
void writeSpmat(const OutputPath& to, const VectorXd& values);

}  // namespace tufted::io
