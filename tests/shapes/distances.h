#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>

#include "tufted/types.h"

/// Distances of points from the shapes of shapes.h.
namespace tufted::shapes {

/// The distance of a position from a surface, negative on one side.
using SurfaceDistance = std::function<double(const Eigen::RowVector3d&)>;

inline double toSphere(const Eigen::RowVector3d& x) {
  return x.norm() - 1;
}

inline double toTorus(const Eigen::RowVector3d& x) {
  return std::hypot(std::hypot(x[0], x[1]) - 1, x[2]) - 0.4;
}

inline double toCube(const Eigen::RowVector3d& x) {
  const Eigen::Array3d out = (x.transpose().array() - 0.5).abs() - 0.5;
  return std::min(0.0, out.maxCoeff()) + out.max(0.0).matrix().norm();
}

inline double rmsDistance(const Points& points, const SurfaceDistance& distance) {
  double sum = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) sum += std::pow(distance(points.row(i)), 2);
  return std::sqrt(sum / static_cast<double>(points.rows()));
}

}  // namespace tufted::shapes
