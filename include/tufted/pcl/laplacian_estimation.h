#pragma once

#include <pcl/pcl_base.h>

#include <string>

#include "tufted/laplacian.h"
#include "tufted/pcl/laplacian_settings.h"

namespace tufted {

/// Computes L, M and what is known about each point, for a PCL cloud.
///
/// They are built from the points that setIndices names, and from them alone: row r of the result belongs to
/// (*indices)[r]. Without indices row r is point r. Points that are NaN, whatever is_dense says, keep a row of zeros. A
/// caller's mistake is reported on PCL's console and leaves an empty result. The viewpoint, which distinguishes jumps
/// from rims in Laplacian::boundary, is the sensor's origin of an organized cloud unless setOptions names another.
///
/// Instantiated for PCL_XYZ_POINT_TYPES; for other types include impl/laplacian_estimation.hpp.
template <typename PointT>
class LaplacianEstimation : public pcl::PCLBase<PointT>, public LaplacianSettings<PointT> {
 public:
  /// As PCL has it.
  using Ptr = pcl::shared_ptr<LaplacianEstimation<PointT>>;
  /// As PCL has it.
  using ConstPtr = pcl::shared_ptr<const LaplacianEstimation<PointT>>;

  /// Builds the Laplacian of the input cloud; `result` is overwritten, with 0 rows if that failed.
  void compute(Laplacian& result);

  /// All options of the core, k and threads included. What they borrow (normals, neighborhoods, structure: one row per
  /// index) must live until compute() is done; a search method or an organized search wins over neighborhoods and
  /// structure.
  void setOptions(const CloudOptions& options) { options_ = options; }
  /// See setOptions().
  const CloudOptions& getOptions() const { return options_; }

  /// "LaplacianEstimation".
  const std::string& getClassName() const { return class_name_; }

 protected:
  using pcl::PCLBase<PointT>::input_;
  using pcl::PCLBase<PointT>::indices_;
  using LaplacianSettings<PointT>::options_;
  using LaplacianSettings<PointT>::search_;
  using LaplacianSettings<PointT>::organized_;

 private:
  std::string class_name_ = "LaplacianEstimation";
};

}  // namespace tufted

#ifdef PCL_NO_PRECOMPILE
#include "tufted/pcl/impl/laplacian_estimation.hpp"
#endif
