#pragma once

#include "tufted/laplacian.h"
#include "tufted/options.h"

namespace tufted {

/// Refines the normals of a cloud (docs/algorithm.md, section 20): a quadratic through two rings of neighbours follows
/// a smooth surface, a plane through the ten nearest points is better next to creases and in thin parts. The one with
/// less variance is used. Signs are kept, and tangents are rotated with the normals.
/// @param laplacian of a cloud; its neighbours in L are not on another sheet
void takeFineNormals(const Laplacian& laplacian, int threads, const Progress& progress, Frames& frames);

}  // namespace tufted
