#pragma once

#include <pcl/pcl_base.h>

#include <string>

#include "tufted/laplacian.h"
#include "tufted/pcl/laplacian_settings.h"

namespace tufted {

/// Computes the Laplacian of a PCL cloud.
///
/// It is built only from the points that setIndices names: row r of the result belongs to (*indices)[r]. Without
/// indices row r is point r. NaN points, whatever is_dense says, keep an empty row. A caller's mistake is reported on
/// PCL's console and leaves an empty result. The viewpoint, which distinguishes jumps from rims in Laplacian::boundary,
/// is the sensor's origin of an organized cloud unless setOptions() gives another one.
///
/// Instantiated for PCL_XYZ_POINT_TYPES; for other types include impl/laplacian_estimation.hpp.
template <typename PointT>
class LaplacianEstimation : public pcl::PCLBase<PointT>, public LaplacianSettings<PointT> {
 public:
  /// Shared pointer, as PCL's classes have it.
  using Ptr = pcl::shared_ptr<LaplacianEstimation<PointT>>;
  /// Shared pointer to const, as PCL's classes have it.
  using ConstPtr = pcl::shared_ptr<const LaplacianEstimation<PointT>>;

  /// Builds the Laplacian of the input cloud.
  /// @param[out] result overwritten, with 0 rows after an error, which is reported on PCL's console
  void compute(Laplacian& result);

  /// Sets all options of the core, k and threads included. What they borrow (normals, neighborhoods, structure, with
  /// one row per index) must live until compute() returns. A search method or an organized search replaces
  /// neighborhoods and structure.
  void setOptions(const CloudOptions& options) { options_ = options; }
  /// See setOptions().
  const CloudOptions& getOptions() const { return options_; }

  /// The name of the class, "LaplacianEstimation".
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
