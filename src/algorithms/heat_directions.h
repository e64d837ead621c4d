#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/heat_rounds.h"
#include "tufted/distance.h"
#include "tufted/types.h"

namespace tufted {

/// The divergence of X = -grad u / |grad u| (weak: N integrals against hat functions), where u is the heat that starts
/// as `heat`. X is zero in the faces that are `still`.
/// @param heat N, >= 0
/// @param still by face; not 0 where X is zero
/// @param report gets rounds, iterations, the residual and the backward error
/// @throws SolverFailure and Cancelled in the name of `function`
VectorXd divergenceOfHeat(const std::string& function, const HeatProblem& problem, const VectorXd& heat,
                          const std::vector<std::uint8_t>& still, int threads, const Progress& progress,
                          DistanceReport& report);

}  // namespace tufted
