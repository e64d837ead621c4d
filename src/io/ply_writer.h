#pragma once

#include <vector>

#include "io/conventions.h"
#include "io/output_file.h"
#include "tufted/io/read.h"
#include "tufted/laplacian.h"

namespace tufted::io {

/// The name of a type in a header; that of double for 64-bit integers, which PLY does not have.
const char* plyType(FieldType type);

/// Writes points.ply as documented at writeLaplacian().
/// @throws IoError
void writePly(const OutputPath& to, const Laplacian& laplacian, const Geometry& geometry, const VectorXd& M,
              const std::vector<Convention>& conventions);

}  // namespace tufted::io
