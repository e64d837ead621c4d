#pragma once

#include <vector>

#include "algorithms/charts.h"
#include "tufted/parameterization.h"

namespace tufted {

/// Lays a chart out so that each point off the rim is the mean of its neighbours by mean value weights (Floater: "Mean
/// value coordinates", 2003, Equation 2.3 at each point).
/// @param uv N x 2; points of the rim have their position. The others of the chart get theirs.
/// @param is_pinned N; not 0 at points of the rim, of which the chart has some
/// @param report gets the residual and the method
/// @throws SolverFailure and Cancelled in the name of `function`
void mapByMeanValues(const char* function, const Points& positions, const Chart& chart,
                     const std::vector<std::uint8_t>& is_pinned, const SolverOptions& options, Eigen::MatrixX2d& uv,
                     ParameterizationReport& report);

}  // namespace tufted
