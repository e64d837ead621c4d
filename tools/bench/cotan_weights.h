#pragma once

#include <utility>

#include "oracles/oracles.h"
#include "tufted/laplacian.h"

namespace tufted::bench {

/// Replaces L and M of a mesh's Laplacian by those of cotan weights.
inline Laplacian withCotan(Laplacian laplacian, const Points& points, const Triangles& triangles) {
  oracles::Operators cotan = oracles::cotanLaplacian(points, triangles);
  laplacian.L = std::move(cotan.L);
  laplacian.M = std::move(cotan.M);
  return laplacian;
}

}  // namespace tufted::bench
