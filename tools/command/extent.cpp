#include "extent.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "options.h"

std::string Extent::text() const {
  return name + " has the size " + numberText(size) + " and the spacing " + numberText(spacing);
}

Extent extentOf(const Operator& source) {
  const tufted::Points& points = source.geometry.points;
  Eigen::AlignedBox3d box;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (source.laplacian.status[static_cast<std::size_t>(i)] == tufted::PointStatus::active)
      box.extend(points.row(i).transpose());
  const double diagonal = box.isEmpty() ? 0 : box.diagonal().norm();
  return {.name = source.name,
          .size = std::max(diagonal, std::sqrt(source.laplacian.M.sum())),
          .spacing = source.laplacian.report.mean_edge};
}
