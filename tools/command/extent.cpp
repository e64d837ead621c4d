#include "extent.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "options.h"

std::string Extent::text() const {
  return name + " has the size " + numberText(size) + " and the spacing " + numberText(spacing);
}

namespace {

double meanEdge(const tufted::Laplacian& laplacian) {
  double sides = 0, length = 0;
  for (const tufted::ComponentEdges& edges : laplacian.component_edges) {
    sides += static_cast<double>(edges.sides);
    length += static_cast<double>(edges.sides) * edges.mean;
  }
  return sides > 0 ? length / sides : 0;
}

}  // namespace

Extent extentOf(const Operator& source) {
  const tufted::Points& points = source.geometry.points;
  Eigen::AlignedBox3d box;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (source.laplacian.status[static_cast<std::size_t>(i)] == tufted::PointStatus::active)
      box.extend(points.row(i).transpose());
  const double diagonal = box.isEmpty() ? 0 : box.diagonal().norm();
  return {.name = source.name,
          .size = std::max(diagonal, std::sqrt(source.laplacian.M.sum())),
          .spacing = meanEdge(source.laplacian)};
}
