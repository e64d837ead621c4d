#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/connected.h"
#include "base/parallel.h"
#include "operators/surface_faces.h"
#include "tufted/distance.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// What heat needs, all in the unit of `surface`.
struct HeatProblem {
  const SurfaceFaces& surface;
  const SparseMatrix& L;
  const Components& components;
  const Solver& closed;      ///< of M + t L
  const Solver* open;        ///< the same without rows and columns where the surface ends; null: not asked for
  const VectorXd& interior;  ///< N; 0 where the surface ends, 1 elsewhere
};

/// The divergence of X = -grad u / |grad u| (weak: N integrals against hat functions), u the heat that starts as
/// `heat`. X is zero in the faces that are `still`.
/// @param heat N, >= 0
/// @param still by face
/// @param report gets rounds, iterations and, if `measure`, the residual
VectorXd divergenceOfHeat(const HeatProblem& problem, const VectorXd& heat, const std::vector<std::uint8_t>& still,
                          const Workers& workers, bool measure, DistanceReport& report);

}  // namespace tufted
