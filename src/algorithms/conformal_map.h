#pragma once

#include <vector>

#include "algorithms/charts.h"
#include "tufted/parameterization.h"

namespace tufted {

/// The spectral conformal parameterisation of a chart with a rim.
/// @param points the points of the chart, ascending
/// @param local for each point of the Laplacian its index in `points`
/// @param report gets iterations, residual and method
/// @return one row (u, v) for each of `points`, determined up to a similarity
/// @throws SolverFailure and Cancelled in the name of `function`
Eigen::MatrixX2d conformalMap(const char* function, const Points& positions, const Chart& chart,
                              const std::vector<int>& points, const std::vector<int>& local,
                              const SolverOptions& options, ParameterizationReport& report);

}  // namespace tufted
