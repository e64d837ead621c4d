#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/charts.h"
#include "tufted/parameterization.h"

namespace tufted {

/// What of a map has collapsed: triangles that are lower in the plane than 1e-7 of its extent, but not on the surface.
struct Collapse {
  std::int64_t triangles = 0;
  double area_share = 0;  ///< of the chart, on the surface
};

/// Gives a chart in the plane the area of its triangles, in units of 2^exponent, turns it so that its longer axis runs
/// along u, and moves it so that its least u and v are 0.
/// @param local of each point, its row in `uv`
/// @return all triangles where it has no area in the plane; `uv` is of no use then
Collapse placeAlone(const Points& positions, const Chart& chart, int exponent, const std::vector<int>& local,
                    Eigen::MatrixX2d& uv);

/// Moves charts beside each other, in rows: higher ones first.
/// @param exponent of the unit 2^exponent of each; they come to be in the caller's unit
void placeBesideEachOther(std::vector<Eigen::MatrixX2d>& charts, const std::vector<int>& exponents);

/// Measures a parameterisation: triangles, flipped, collapsed and quasi_conformal_error.
/// @param owner of each point, the chart whose position it has
void measureMaps(const Points& positions, const std::vector<const Chart*>& charts, const std::vector<int>& owner,
                 const Eigen::MatrixX2d& uv, ParameterizationReport& report);

}  // namespace tufted
