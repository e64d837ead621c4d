#pragma once

#include <pcl/features/feature.h>

#include "tufted/pcl/build_settings.h"
#include "tufted/pcl/surface_values.h"

namespace tufted {

namespace detail {

/// The part of SurfaceFeature that does not depend on the type of the output, so that it is compiled once per input.
template <typename PointInT>
class FeatureRows : public SurfaceSettings {
 protected:
  /// What a pcl::Feature was given.
  struct Given {
    typename pcl::PointCloud<PointInT>::ConstPtr input;           ///< see setInputCloud()
    typename pcl::PointCloud<PointInT>::ConstPtr search_surface;  ///< see setSearchSurface()
    typename pcl::search::Search<PointInT>::Ptr search;           ///< see setSearchMethod()
    const pcl::Indices& indices;                                  ///< see setIndices()
    int k;                                                        ///< see setKSearch()
    double radius;                                                ///< see setRadiusSearch()
  };

  FeatureRows() = default;
  virtual ~FeatureRows() = default;

  /// Computes the values of all points.
  /// @param viewpoint position of the sensor, null if unknown
  virtual PointValues valuesOf(const Laplacian& laplacian, const Eigen::Vector3d* viewpoint) = 0;
  /// Computes one row per index, of NaN where a point takes no part, and reports mistakes.
  /// @param[out] all whether all points have values
  /// @return whether there was no mistake
  bool computeRows(const std::string& class_name, const Given& given, PointValues& rows, bool& all);
};

}  // namespace detail

/// Base of the classes that compute something at each point of a surface, as a pcl::Feature.
///
/// The surface is that of all finite points of the input, or the one of setSurface(). The output has one point per
/// index or, without indices, the width and height of the input. A point that takes no part (NaN, isolated) gets NaN,
/// and then is_dense is false; SurfaceSettings::getSurface() has its status. Coincident points have the values of their
/// representative.
///
/// Neither k nor a radius must be set: setKSearch(0), PCL's default, stands for CloudOptions::neighbors. Without
/// setSearchMethod() the library searches by itself. A radius and a search surface are refused. A caller's mistake is
/// reported on PCL's console and leaves an empty output.
template <typename PointInT, typename PointOutT>
class SurfaceFeature : public pcl::Feature<PointInT, PointOutT>, public detail::FeatureRows<PointInT> {
 public:
  /// Type of the output.
  using PointCloudOut = typename pcl::Feature<PointInT, PointOutT>::PointCloudOut;
  using pcl::Feature<PointInT, PointOutT>::getClassName;

 protected:
  using pcl::Feature<PointInT, PointOutT>::input_;
  using pcl::Feature<PointInT, PointOutT>::indices_;
  using pcl::Feature<PointInT, PointOutT>::surface_;
  using pcl::Feature<PointInT, PointOutT>::tree_;
  using pcl::Feature<PointInT, PointOutT>::k_;
  using pcl::Feature<PointInT, PointOutT>::search_radius_;

  SurfaceFeature() = default;

  /// Fills a point of the output.
  /// @param values those of the point, NaN if it takes no part
  virtual void fill(const PointInT& point, const float* values, PointOutT& output) const = 0;

 private:
  /// Not that of pcl::Feature, which makes a tree and demands k or a radius.
  bool initCompute() override { return pcl::PCLBase<PointInT>::initCompute(); }
  void computeFeature(PointCloudOut& output) override;
};

}  // namespace tufted

#ifdef PCL_NO_PRECOMPILE
#include "tufted/pcl/impl/surface_feature.hpp"
#endif
