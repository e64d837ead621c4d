#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/charts.h"
#include "tufted/parameterization.h"

namespace tufted {

/// The collapsed triangles of a map: those lower in the plane than 1e-7 of the map's extent, but not on the surface.
struct Collapse {
  std::int64_t triangles = 0;
  double area_share = 0;  ///< their area on the surface over that of the chart
};

/// Scales a chart in the plane to the area of its triangles, in units of 2^exponent, rotates it so that its longer axis
/// runs along u, and moves it so that its least u and v are 0.
/// @param local for each point of the Laplacian its row in `uv`
/// @return all triangles if the area in the plane is not positive; `uv` is then unusable
Collapse placeAlone(const Points& positions, const Chart& chart, int exponent, const std::vector<int>& local,
                    Eigen::MatrixX2d& uv);

/// Places charts beside each other in rows: the first one at the origin, then by falling height.
/// @param[in,out] charts each in its unit 2^exponent, on return in the caller's unit
void placeBesideEachOther(std::vector<Eigen::MatrixX2d>& charts, const std::vector<int>& exponents);

/// Measures a parameterisation and sets `triangles`, `flipped`, `collapsed` and `quasi_conformal_error` of the report.
/// @param owner for each point the chart that its position in `uv` belongs to
void measureMaps(const Points& positions, const std::vector<const Chart*>& charts, const std::vector<int>& owner,
                 const Eigen::MatrixX2d& uv, ParameterizationReport& report);

}  // namespace tufted
