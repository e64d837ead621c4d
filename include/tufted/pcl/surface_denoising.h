#pragma once

#include <pcl/filters/filter.h>

#include "tufted/denoise.h"
#include "tufted/pcl/build_settings.h"

namespace tufted {

/// Moves the points of a noisy cloud onto the surface, without a radius to choose; see tufted::denoise.
///
/// The surface is found from all finite points of the input; those of a depth image move along their rays, see
/// setOrganizedSearch(). With setIndices only the points named move. All other
/// fields, normals too, the order, width and height, header and sensor pose are copied. NaN points stay NaN in place,
/// and is_dense says whether there are any. Nothing is removed, so getRemovedIndices is always empty. The output may be
/// the input. A caller's mistake is reported on PCL's console and leaves an empty output.
///
/// Instantiated for PCL_XYZ_POINT_TYPES; for other types include impl/surface_denoising.hpp.
template <typename PointT>
class SurfaceDenoising : public pcl::Filter<PointT>, public OrganizedSettings {
 public:
  /// Shared pointer, as PCL's classes have it.
  using Ptr = pcl::shared_ptr<SurfaceDenoising<PointT>>;
  /// Shared pointer to const, as PCL's classes have it.
  using ConstPtr = pcl::shared_ptr<const SurfaceDenoising<PointT>>;
  /// Type of input and output.
  using PointCloud = typename pcl::Filter<PointT>::PointCloud;

  SurfaceDenoising() { this->filter_name_ = "SurfaceDenoising"; }

  /// At most this many threads; 0 (default): one per processor.
  void setNumberOfThreads(unsigned int threads = 0) { threads_ = static_cast<int>(threads); }
  /// See setNumberOfThreads().
  unsigned int getNumberOfThreads() const { return static_cast<unsigned int>(threads_); }

  /// Report of the last filter(): points moved, outliers, the noise in the cloud's unit.
  const DenoiseReport& getReport() const { return report_; }

  using pcl::Filter<PointT>::getClassName;

 protected:
  using pcl::PCLBase<PointT>::input_;
  using pcl::PCLBase<PointT>::indices_;

  /// Called by filter().
  void applyFilter(PointCloud& output) override;

 private:
  int threads_ = 0;
  DenoiseReport report_;
};

}  // namespace tufted

#ifdef PCL_NO_PRECOMPILE
#include "tufted/pcl/impl/surface_denoising.hpp"
#endif
