#pragma once

#include <vector>

#include "algorithms/charts.h"
#include "tufted/parameterization.h"

namespace tufted {

/// Maps a chart so that each free point is the mean of its neighbours by mean value weights (Floater: "Mean value
/// coordinates", 2003, Equation 2.3).
/// @param uv N x 2; positions of pinned points are given, those of the chart's other points are set
/// @param is_pinned N; not 0 at points of the rim
/// @param report gets the residual and the method
/// @throws SolverFailure and Cancelled in the name of `function`
void mapByMeanValues(const char* function, const Points& positions, const Chart& chart,
                     const std::vector<std::uint8_t>& is_pinned, const SolverOptions& options, Eigen::MatrixX2d& uv,
                     ParameterizationReport& report);

}  // namespace tufted
