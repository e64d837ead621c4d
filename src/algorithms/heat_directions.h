#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/connected.h"
#include "algorithms/linear_system.h"
#include "base/parallel.h"
#include "operators/surface_faces.h"
#include "tufted/distance.h"
#include "tufted/types.h"

namespace tufted {

/// To which conjugate gradients must solve for heat, as it is looked at far below its largest value.
constexpr double heat_tolerance = 1e-12;

/// What heat needs, all in the unit of `surface`.
struct HeatProblem {
  const SurfaceFaces& surface;
  const SparseMatrix& L;
  const Components& components;
  const LinearSystem& closed;  ///< of M + t L
  const LinearSystem* open;    ///< the same without rows and columns where the surface ends; null: not asked for
  const VectorXd& interior;    ///< N; 0 where the surface ends, 1 elsewhere
};

/// The divergence of X = -grad u / |grad u| (weak: N integrals against hat functions), u the heat that starts as
/// `heat`. X is zero in the faces that are `still`.
/// @param heat N, >= 0
/// @param still by face
/// @param report gets rounds, iterations, the residual and the backward error
/// @throws SolverFailure and Cancelled in the name of `function`
VectorXd divergenceOfHeat(const std::string& function, const HeatProblem& problem, const VectorXd& heat,
                          const std::vector<std::uint8_t>& still, int threads, const Progress& progress,
                          DistanceReport& report);

}  // namespace tufted
