#pragma once

#include <vector>

#include "io/conventions.h"
#include "io/output_file.h"
#include "tufted/io/read.h"
#include "tufted/laplacian.h"

namespace tufted::io {

/// Writes points.pcd as documented at writeLaplacian().
/// @throws IoError
void writePcd(const OutputPath& to, const Laplacian& laplacian, const Geometry& geometry, const VectorXd& M,
              const std::vector<Convention>& conventions);

}  // namespace tufted::io
