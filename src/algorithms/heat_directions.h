#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/heat_rounds.h"
#include "tufted/distance.h"
#include "tufted/types.h"

namespace tufted {

/// The weak divergence (N integrals against hat functions) of X = -grad u / |grad u|, where u is the heat that spreads
/// from `heat`.
/// @param heat N, >= 0
/// @param still by face; other than 0 where X is set to 0
/// @param report gets rounds, iterations, the residual and the backward error
/// @throws SolverFailure and Cancelled in the name of `function`
VectorXd divergenceOfHeat(const std::string& function, const HeatProblem& problem, const VectorXd& heat,
                          const std::vector<std::uint8_t>& still, int threads, const Progress& progress,
                          DistanceReport& report);

}  // namespace tufted
