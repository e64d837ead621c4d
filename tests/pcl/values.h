#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "tufted/pcl/surface_values.h"

/// What outputs of features hold, as matrices to compare.
namespace tufted::pcl_tests {

using detail::PointValues;

/// What the outputs hold, one row per point.
inline PointValues valuesOf(const pcl::PointCloud<pcl::Normal>& cloud) {
  PointValues values(static_cast<Eigen::Index>(cloud.size()), 4);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    values.row(i) << cloud[i].normal_x, cloud[i].normal_y, cloud[i].normal_z, cloud[i].curvature;
  return values;
}
inline PointValues valuesOf(const pcl::PointCloud<pcl::PrincipalCurvatures>& cloud) {
  PointValues values(static_cast<Eigen::Index>(cloud.size()), 5);
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const auto& at = cloud[i];
    values.row(i) << at.principal_curvature_x, at.principal_curvature_y, at.principal_curvature_z, at.pc1, at.pc2;
  }
  return values;
}
inline PointValues valuesOf(const pcl::PointCloud<pcl::Boundary>& cloud) {
  PointValues values(static_cast<Eigen::Index>(cloud.size()), 1);
  for (Eigen::Index i = 0; i < values.rows(); ++i) values(i, 0) = cloud[i].boundary_point;
  return values;
}
inline PointValues valuesOf(const pcl::PointCloud<pcl::Histogram<16>>& cloud) {
  PointValues values(static_cast<Eigen::Index>(cloud.size()), 16);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    values.row(i) = Eigen::Map<const Eigen::RowVectorXf>(cloud[i].histogram, 16);
  return values;
}

inline bool same(const PointValues& a, const PointValues& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         ((a.array() == b.array()) || (a.array().isNaN() && b.array().isNaN())).all();
}

}  // namespace tufted::pcl_tests
