#pragma once

#include <string>
#include <vector>

#include "algorithms/charts.h"
#include "algorithms/connected.h"

namespace tufted {

/// The volumes that the components of a surface enclose. Small holes in the triangles of a cloud are closed by fans.
class EnclosedVolume {
 public:
  /// @param function named in errors
  /// @param points N x 3, finite at active points
  /// @throws InvalidInput for indices out of range, and for a component without triangles, with an edge of more than
  /// two, nonorientable, or with a rim (on a cloud, with fans over rims of more than 5 % of the area)
  EnclosedVolume(const std::string& function, const Laplacian& laplacian, const TrianglesRef& triangles,
                 const Eigen::MatrixXd& points);

  /// Scales each component about its centre of mass to the volume that it had at construction.
  /// @param x N x 3, finite at active points; other rows do not change
  /// @throws InvalidInput if a component encloses no volume, at construction or now
  void restore(Eigen::MatrixXd& x) const;

 private:
  /// Measures of one component.
  struct Body {
    Eigen::RowVector3d centre;
    int exponent;      ///< binary exponent of the largest distance from the centre along an axis
    double volume;     ///< in units of 2^(3 exponent)
    double area;       ///< area of the triangles, in units of 2^(2 exponent)
    double hole_area;  ///< area of the fans that close holes, in the same unit
  };
  Body measure(const Eigen::MatrixXd& x, int component) const;

  std::string function_;
  Components components_;
  VectorXd weights_;                           ///< N; see Components::weights()
  std::vector<std::vector<int>> points_;       ///< by component
  std::vector<std::vector<const Chart*>> of_;  ///< by component
  std::vector<Chart> charts_;
  std::vector<Body> before_;  ///< by component
};

}  // namespace tufted
