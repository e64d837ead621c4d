#pragma once

#include <Eigen/Core>

#include "shapes/shapes.h"

namespace tufted::support {

/// Both meshes as one: the vertices and triangles of the second follow those of the first.
inline shapes::Mesh joined(shapes::Mesh first, const shapes::Mesh& second,
                           const Eigen::RowVector3d& offset_of_second = Eigen::RowVector3d::Zero()) {
  const auto points = static_cast<int>(first.points.rows());
  const Eigen::Index triangles = first.triangles.rows();
  first.points.conservativeResize(points + second.points.rows(), 3);
  first.points.bottomRows(second.points.rows()) = second.points.rowwise() + offset_of_second;
  first.triangles.conservativeResize(triangles + second.triangles.rows(), 3);
  first.triangles.bottomRows(second.triangles.rows()) = second.triangles.array() + points;
  return first;
}

}  // namespace tufted::support
