#pragma once

#include "tufted/pcl/impl/surface_feature.hpp"
#include "tufted/pcl/principal_curvature_estimation.h"

template <typename PointInT>
void tufted::PrincipalCurvatureEstimation<PointInT>::fill(const PointInT&, const float* values,
                                                          pcl::PrincipalCurvatures& output) const {
  for (int axis = 0; axis < 3; ++axis) output.principal_curvature[axis] = values[axis];
  output.pc1 = values[3];
  output.pc2 = values[4];
}

#define PCL_INSTANTIATE_PrincipalCurvatureEstimation(T)                           \
  template class PCL_EXPORTS tufted::SurfaceFeature<T, pcl::PrincipalCurvatures>; \
  template class PCL_EXPORTS tufted::PrincipalCurvatureEstimation<T>;
