#pragma once

#include <pcl/point_types.h>

#include "tufted/pcl/surface_feature.h"

namespace tufted {

/// Computes principal curvatures, see curvatures(): pc1 >= pc2 in 1 / length, with a sign, and the direction of pc1.
///
/// They are positive where the surface bends away from the normals that OrientedNormalEstimation computes with the same
/// settings, so those of a sphere are 1 / radius seen from outside. Their mean is its field `curvature`. See
/// SurfaceFeature for what all features have in common.
///
/// Instantiated for PCL_XYZ_POINT_TYPES; for other types include impl/principal_curvature_estimation.hpp.
template <typename PointInT>
class PrincipalCurvatureEstimation : public SurfaceFeature<PointInT, pcl::PrincipalCurvatures> {
 public:
  /// Shared pointer, as PCL's classes have it.
  using Ptr = pcl::shared_ptr<PrincipalCurvatureEstimation<PointInT>>;
  /// Shared pointer to const, as PCL's classes have it.
  using ConstPtr = pcl::shared_ptr<const PrincipalCurvatureEstimation<PointInT>>;

  PrincipalCurvatureEstimation() { this->feature_name_ = "PrincipalCurvatureEstimation"; }

 private:
  detail::PointValues valuesOf(const Laplacian& laplacian, const Eigen::Vector3d* viewpoint) override {
    return detail::principalCurvatures(laplacian, viewpoint, this->getOptions().threads);
  }
  void fill(const PointInT&, const float* values, pcl::PrincipalCurvatures& output) const override;
};

}  // namespace tufted

#ifdef PCL_NO_PRECOMPILE
#include "tufted/pcl/impl/principal_curvature_estimation.hpp"
#endif
