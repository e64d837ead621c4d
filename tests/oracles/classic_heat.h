#pragma once

#include "tufted/types.h"

namespace tufted::oracles {

/// The heat method as published (Crane, Weischedel, Wardetzky 2013, Algorithm 1) with the plain cotan Laplacian, for
/// triangles of any connectivity: t the mean squared edge, free boundary, 0 at the source. NaN where a matrix has no
/// factor, as with triangles of no area.
VectorXd classicHeatDistances(const Points& points, const Triangles& triangles, int source);

}  // namespace tufted::oracles
