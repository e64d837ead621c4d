#pragma once

#include "tufted/laplacian.h"

namespace tufted {

/// Normals of a cloud, over the surface near each point. A quadratic through two rings of neighbours bends with a
/// smooth surface; next to creases and thin parts a plane through the ten nearest points is nearer to it. The one is
/// taken that leaves less variance, by degrees of freedom. Signs stay, and tangents are turned with the normals.
/// @param laplacian of a cloud; neighbours are those of L, which are not on another sheet
void takeFineNormals(const Laplacian& laplacian, Frames& frames);

}  // namespace tufted
