#pragma once

#include <pcl/pcl_base.h>

#include <memory>
#include <string>

#include "tufted/laplacian.h"
#include "tufted/pcl/laplacian_settings.h"

namespace tufted {

/// Computes the Laplacian of a PCL cloud, which the other classes take by setSurface().
///
/// It is built only from the points that setIndices names: row r of the result belongs to (*indices)[r], also in what
/// setOptions() is given. Without indices row r is point r. NaN points, whatever is_dense says, keep an empty row. A
/// caller's mistake is reported on PCL's console and leaves an empty result.
///
/// Instantiated for PCL_XYZ_POINT_TYPES; for other types include impl/laplacian_estimation.hpp.
template <typename PointT>
class LaplacianEstimation : public pcl::PCLBase<PointT>, public LaplacianSettings<PointT, BuildSettings> {
 public:
  /// Shared pointer, as PCL's classes have it.
  using Ptr = pcl::shared_ptr<LaplacianEstimation<PointT>>;
  /// Shared pointer to const, as PCL's classes have it.
  using ConstPtr = pcl::shared_ptr<const LaplacianEstimation<PointT>>;

  /// Builds the Laplacian of the input cloud and keeps memory for the next one, see LaplacianBuilder. The memory of a
  /// result is used again once nobody holds the result.
  /// @return with 0 rows after an error, which is reported on PCL's console; never null
  std::shared_ptr<const Laplacian> compute();
  /// Builds the Laplacian of the input cloud in new memory.
  /// @param[out] result overwritten, with 0 rows after an error, which is reported on PCL's console
  void compute(Laplacian& result);

  /// The name of the class, "LaplacianEstimation".
  const std::string& getClassName() const { return class_name_; }

 protected:
  using pcl::PCLBase<PointT>::input_;
  using pcl::PCLBase<PointT>::indices_;
  using pcl::PCLBase<PointT>::fake_indices_;
  using LaplacianSettings<PointT, BuildSettings>::search_;

 private:
  /// Calls `build` with the input, reports what it throws, and returns whether it succeeded.
  template <class Build>
  bool run(const Build& build);

  std::string class_name_ = "LaplacianEstimation";
};

}  // namespace tufted

#ifdef PCL_NO_PRECOMPILE
#include "tufted/pcl/impl/laplacian_estimation.hpp"
#endif
