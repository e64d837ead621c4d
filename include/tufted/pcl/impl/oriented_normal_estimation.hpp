#pragma once

#include "tufted/pcl/impl/surface_feature.hpp"
#include "tufted/pcl/oriented_normal_estimation.h"

template <typename PointInT, typename PointOutT>
void tufted::OrientedNormalEstimation<PointInT, PointOutT>::fill(const PointInT& point, const float* values,
                                                                 PointOutT& output) const {
  if constexpr (requires { output.x; }) {
    output.x = point.x;
    output.y = point.y;
    output.z = point.z;
  }
  for (int axis = 0; axis < 3; ++axis) output.normal[axis] = values[axis];
  output.curvature = values[3];
}

#define PCL_INSTANTIATE_OrientedNormalEstimation(T)                            \
  template class PCL_EXPORTS tufted::SurfaceFeature<T, pcl::Normal>;           \
  template class PCL_EXPORTS tufted::OrientedNormalEstimation<T, pcl::Normal>; \
  template class PCL_EXPORTS tufted::SurfaceFeature<T, pcl::PointNormal>;      \
  template class PCL_EXPORTS tufted::OrientedNormalEstimation<T, pcl::PointNormal>;
