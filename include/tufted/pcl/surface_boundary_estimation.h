#pragma once

#include <pcl/point_types.h>

#include "tufted/pcl/surface_feature.h"

namespace tufted {

/// Finds where the surface ends, and why: boundary_point is the value of a tufted::Boundary, 0 where it goes on, 1 at a
/// rim, 2 at a jump, 3 where triangles were lost.
///
/// pcl::Boundary has no NaN: a point that takes no part gets 0, and is_dense is false. See SurfaceFeature for what all
/// features have in common.
///
/// Instantiated for PCL_XYZ_POINT_TYPES; for other types include impl/surface_boundary_estimation.hpp.
template <typename PointInT>
class SurfaceBoundaryEstimation : public SurfaceFeature<PointInT, pcl::Boundary> {
 public:
  /// Shared pointer, as PCL's classes have it.
  using Ptr = pcl::shared_ptr<SurfaceBoundaryEstimation<PointInT>>;
  /// Shared pointer to const, as PCL's classes have it.
  using ConstPtr = pcl::shared_ptr<const SurfaceBoundaryEstimation<PointInT>>;

  SurfaceBoundaryEstimation() { this->feature_name_ = "SurfaceBoundaryEstimation"; }

 private:
  detail::PointValues valuesOf(const Laplacian& laplacian, const Eigen::Vector3d*) override {
    return detail::boundaryKinds(laplacian);
  }
  void fill(const PointInT&, const float* values, pcl::Boundary& output) const override;
};

}  // namespace tufted

#ifdef PCL_NO_PRECOMPILE
#include "tufted/pcl/impl/surface_boundary_estimation.hpp"
#endif
