#pragma once

#include <vector>

#include "io/conventions.h"
#include "io/output_file.h"
#include "tufted/io/read.h"
#include "tufted/laplacian.h"

namespace tufted::io {

/// Writes points.ply as documented at writeLaplacian().
/// @throws IoError
void writePly(const OutputPath& to, const Laplacian& laplacian, const Geometry& geometry, const VectorXd& M,
              const std::vector<Convention>& conventions);

/// Writes points.pcd as documented at writeLaplacian().
/// @throws IoError
void writePcd(const OutputPath& to, const Laplacian& laplacian, const Geometry& geometry, const VectorXd& M,
              const std::vector<Convention>& conventions);

/// Writes points.las as documented at writeLaplacian().
/// @throws InvalidInput if LAS cannot hold the points or their fields, naming the reason
/// @throws IoError
void writeLas(const OutputPath& to, const Laplacian& laplacian, const Geometry& geometry, const VectorXd& M);

/// @throws InvalidInput as writeLas(), which writes nothing then either
void checkLas(const Laplacian& laplacian, const Geometry& geometry, const VectorXd& M);

}  // namespace tufted::io
