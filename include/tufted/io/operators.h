#pragma once

#include <filesystem>

#include "tufted/gradient.h"
#include "tufted/io/read.h"
#include "tufted/io/results.h"
#include "tufted/laplacian.h"
#include "tufted/spectrum.h"

namespace tufted {

/// Writes operators.npz into the directory `dir`, which is created if missing, with the names and shapes of
/// DiffusionNet's cache of operators (Sharp et al. 2022):
///   verts          N x 3, float64
///   faces          F x 3, int64; 0 x 3 for clouds
///   frames         N x 3 x 3, float64: tangent, cross(normal, tangent) and normal of each point
///   k_eig          int64, k
///   mass           N, float64
///   L, gradX, gradY as _data (float64), _indices, _indptr (int32) and _shape (int64), N x N in csc; L positive
///                  semidefinite
///   evals, evecs   k and N x k, float64
/// All numbers are those of the library bit for bit; DiffusionNet's own cache has float32. Like writeResults(), it also
/// writes copies of the points, with the fields frames and evecs, and report.json.
/// @param gradients,spectrum of `laplacian`
/// @throws InvalidInput for arrays that differ in their number of points or of eigenvalues, or matrices that are not
/// compressed
/// @throws IoError naming the path
/// @throws Cancelled when `options.progress` returns false
void writeOperators(const std::filesystem::path& dir, const Laplacian& laplacian, const Geometry& geometry,
                    const Gradients& gradients, const Spectrum& spectrum, const ResultOptions& options = {});

}  // namespace tufted
