#pragma once

#include "tufted/types.h"

namespace tufted::oracles {

/// Distances by the heat method as published (Crane, Weischedel, Wardetzky 2013, Algorithm 1) with the plain cotan
/// Laplacian, for triangles of any connectivity: t is the mean squared edge length, the boundary condition Neumann. NaN
/// if a matrix has no factor, as with triangles without area.
VectorXd classicHeatDistances(const Points& points, const Triangles& triangles, int source);

}  // namespace tufted::oracles
