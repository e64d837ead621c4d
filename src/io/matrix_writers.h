#pragma once

#include <vector>

#include "io/conventions.h"
#include "io/output_file.h"
#include "tufted/laplacian.h"
#include "tufted/types.h"

namespace tufted::io {

/// Writes laplacian.mat as documented at writeLaplacian(), without compression.
/// @param L compressed
/// @throws IoError, also where a variable is larger than the format allows
void writeMat(const OutputPath& to, const SparseMatrix& L, const VectorXd& M, const Laplacian& laplacian,
              const std::vector<Convention>& conventions);

/// Writes a matrix as PETSc's MatLoad() reads it: big-endian, by rows, 32-bit indices
/// (https://petsc.org/release/manualpages/Mat/MatLoad/). @throws IoError
void writePetsc(const OutputPath& to, const SparseMatrix& matrix);
/// Writes a vector as PETSc's VecLoad() reads it. @throws IoError
void writePetsc(const OutputPath& to, const VectorXd& values);

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

/// Writes a matrix as scipy.sparse.save_npz does (csc, int32 indices). The same matrix gives the same bytes.
/// @param matrix compressed
/// @throws IoError
void writeNpz(const OutputPath& to, const SparseMatrix& matrix);

}  // namespace tufted::io
