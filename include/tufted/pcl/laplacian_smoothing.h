#pragma once

#include <pcl/filters/filter.h>

#include <string>

#include "tufted/laplacian.h"
#include "tufted/pcl/laplacian_settings.h"
#include "tufted/smoothing.h"

namespace tufted {

/// Smooths the positions of a cloud by implicit steps (M + t L) x' = M x; see tufted::smooth.
///
/// The Laplacian is that of all finite points of the input, or the one of setSurface(). With setIndices only the points
/// named move; all others, and every copy of them, stay in place. All other fields, the order, width and height, header
/// and sensor pose are copied. NaN points stay NaN in place, and is_dense says whether there are any. Nothing is
/// removed, so getRemovedIndices is always empty. The output may be the input. A caller's mistake is reported on PCL's
/// console and leaves an empty output.
///
/// Instantiated for PCL_XYZ_POINT_TYPES; for other types include impl/laplacian_smoothing.hpp.
template <typename PointT>
class LaplacianSmoothing : public pcl::Filter<PointT>, public LaplacianSettings<PointT> {
 public:
  /// Shared pointer, as PCL's classes have it.
  using Ptr = pcl::shared_ptr<LaplacianSmoothing<PointT>>;
  /// Shared pointer to const, as PCL's classes have it.
  using ConstPtr = pcl::shared_ptr<const LaplacianSmoothing<PointT>>;
  /// Type of input and output.
  using PointCloud = typename pcl::Filter<PointT>::PointCloud;

  LaplacianSmoothing() {
    this->filter_name_ = "LaplacianSmoothing";
    this->options_.keep_cover = false;
  }

  /// Time step t in [0, 1e10], in units of the mean squared edge length, 1 by default; see SmoothingOptions::time_step.
  void setTimeStep(double time_step) { time_step_ = time_step; }
  /// See setTimeStep().
  double getTimeStep() const { return time_step_; }

  /// Number of steps, at least 1, all with the Laplacian of the input; 1 by default.
  void setIterations(int iterations) { iterations_ = iterations; }
  /// See setIterations().
  int getIterations() const { return iterations_; }

  /// Report of the Laplacian in the last filter(): odd points, edge lengths, costs.
  const Report& getReport() const { return report_; }

  using pcl::Filter<PointT>::getClassName;

 protected:
  using pcl::PCLBase<PointT>::input_;
  using pcl::PCLBase<PointT>::indices_;
  using LaplacianSettings<PointT>::search_;

  /// Called by filter().
  void applyFilter(PointCloud& output) override;

 private:
  double time_step_ = 1;
  int iterations_ = 1;
  Report report_;
};

}  // namespace tufted

#ifdef PCL_NO_PRECOMPILE
#include "tufted/pcl/impl/laplacian_smoothing.hpp"
#endif
