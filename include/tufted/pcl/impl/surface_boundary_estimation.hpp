#pragma once

#include <cstdint>

#include "tufted/pcl/impl/surface_feature.hpp"
#include "tufted/pcl/surface_boundary_estimation.h"

template <typename PointInT>
void tufted::SurfaceBoundaryEstimation<PointInT>::fill(const PointInT&, const float* values,
                                                       pcl::Boundary& output) const {
  output.boundary_point = values[0] > 0 ? static_cast<std::uint8_t>(values[0]) : 0;
}

#define PCL_INSTANTIATE_SurfaceBoundaryEstimation(T)                   \
  template class PCL_EXPORTS tufted::SurfaceFeature<T, pcl::Boundary>; \
  template class PCL_EXPORTS tufted::SurfaceBoundaryEstimation<T>;
