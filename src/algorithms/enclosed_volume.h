#pragma once

#include <string>
#include <vector>

#include "algorithms/charts.h"
#include "algorithms/connected.h"

namespace tufted {

/// The volumes that closed surfaces enclose. Small holes in the triangles of a cloud are closed by fans.
class EnclosedVolume {
 public:
  /// @param function to be named in errors
  /// @param points N x 3, finite at active points
  /// @throws InvalidInput for a component that has no triangles, or whose triangles have a rim, an edge of more than
  ///         two triangles or one side alone, and for indices out of range. On a cloud rims may be there, if what they
  ///         surround has little area.
  EnclosedVolume(const std::string& function, const Laplacian& laplacian, const TrianglesRef& triangles,
                 const Eigen::MatrixXd& points);

  /// Scales each component about its centre of mass so that it encloses what it enclosed at first.
  /// @param x N x 3, finite at active points; rows of points that are not active are left alone
  /// @throws InvalidInput where a component enclosed no volume at first, or now
  void restore(Eigen::MatrixXd& x) const;

 private:
  /// Centre of mass and volume of one component.
  struct Body {
    Eigen::RowVector3d centre;
    int exponent;      ///< binary, of the largest distance from the centre along an axis
    double volume;     ///< in units of 2^(3 exponent)
    double area;       ///< of triangles, in units of 2^(2 exponent)
    double hole_area;  ///< of the fans that close holes, in the same
  };
  Body measure(const Eigen::MatrixXd& x, int component) const;

  std::string function_;
  Components components_;
  VectorXd weights_;                           ///< N; M over its sum per component
  std::vector<std::vector<int>> points_;       ///< by component
  std::vector<std::vector<const Chart*>> of_;  ///< by component
  std::vector<Chart> charts_;
  std::vector<Body> before_;  ///< by component
};

}  // namespace tufted
