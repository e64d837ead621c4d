#pragma once

#include "io/output_file.h"
#include "tufted/types.h"

namespace tufted::io {

/// Writes a matrix as PETSc's MatLoad() reads it: big-endian, by rows, 32-bit indices
/// (https://petsc.org/release/manualpages/Mat/MatLoad/). @throws IoError
void writePetsc(const OutputPath& to, const SparseMatrix& matrix);
/// Writes a vector as PETSc's VecLoad() reads it. @throws IoError
void writePetsc(const OutputPath& to, const VectorXd& values);

}  // namespace tufted::io
