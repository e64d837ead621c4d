#pragma once

#include <pcl/point_types.h>

#include "tufted/pcl/surface_feature.h"

namespace tufted {

/// Computes oriented normals and mean curvature, see orientedFrames() and curvatures().
///
/// Normals face the viewpoint if it is known, see setViewPoint(). Otherwise neighbours agree, and components face
/// outwards. The field `curvature` holds the mean curvature in 1 / length, positive where the surface bends away from
/// the normal; that of pcl::NormalEstimation is a ratio of eigenvalues. A pcl::PointNormal also gets the position of
/// its point. See SurfaceFeature for what all features have in common.
///
/// Instantiated for PCL_XYZ_POINT_TYPES and the outputs pcl::Normal and pcl::PointNormal; for other types include
/// impl/oriented_normal_estimation.hpp.
template <typename PointInT, typename PointOutT = pcl::Normal>
class OrientedNormalEstimation : public SurfaceFeature<PointInT, PointOutT> {
 public:
  /// Shared pointer, as PCL's classes have it.
  using Ptr = pcl::shared_ptr<OrientedNormalEstimation<PointInT, PointOutT>>;
  /// Shared pointer to const, as PCL's classes have it.
  using ConstPtr = pcl::shared_ptr<const OrientedNormalEstimation<PointInT, PointOutT>>;

  OrientedNormalEstimation() { this->feature_name_ = "OrientedNormalEstimation"; }

  /// Whether curvature is computed, which takes most of the time; true by default. Otherwise the field holds NaN.
  void setComputeCurvature(bool curvature) { curvature_ = curvature; }
  /// See setComputeCurvature().
  bool getComputeCurvature() const { return curvature_; }

 private:
  detail::PointValues valuesOf(const Laplacian& laplacian, const Eigen::Vector3d* viewpoint) override {
    return detail::normalsAndCurvature(laplacian, viewpoint, curvature_, this->getOptions().threads);
  }
  void fill(const PointInT& point, const float* values, PointOutT& output) const override;

  bool curvature_ = true;
};

}  // namespace tufted

#ifdef PCL_NO_PRECOMPILE
#include "tufted/pcl/impl/oriented_normal_estimation.hpp"
#endif
