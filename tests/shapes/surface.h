#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

#include "shapes/shapes.h"

namespace tufted::shapes {

/// A point of a surface, the unit normal there, and the area per unit of the parameters (t, s).
struct SurfacePoint {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;
  double stretch;
};

/// A surface made of rows: t in [0, span] numbers the rows (by arc length if possible), s in [0, 1] runs along one.
struct Surface {
  std::string name{};
  double span = 1;
  std::function<SurfacePoint(double t, double s)> at{};
  double max_stretch = 1;  ///< upper bound of the stretch, for rejection sampling
  double area = 0;
  bool rim_first = false;  ///< whether t = 0 is a boundary
  bool rim_last = false;   ///< whether t = span is a boundary
  bool rim_sides = false;  ///< whether s = 0 and s = 1 are boundaries; otherwise rows are closed
  VectorXd eigenvalues{};
};

Surface sphereSurface();
Surface ellipsoidSurface(double a, double b, double c);  ///< a >= b >= c
Surface squareSurface();
Surface diskSurface();
Surface torusSurface(double major_radius, double minor_radius);
Surface cylinderSurface();
Surface saddleSurface();

/// Samples n points of the surface (Sampling::lattice: about n).
Cloud sampleSurface(const Surface& surface, int n, Sampling sampling, Rim rim, std::uint64_t seed);

}  // namespace tufted::shapes
