#pragma once

#include <pcl/filters/filter.h>
#include <pcl/search/search.h>

#include <string>

#include "tufted/laplacian.h"
#include "tufted/smoothing.h"

namespace tufted {

/// Smooths the positions of a cloud by implicit steps (M + t L) x' = M x; see tufted::smooth.
///
/// The operator is built from all finite points of the input. With setIndices only the points named move; all others,
/// with every copy of them, stay in place. Every other field, the order, width and height, header and sensor pose are
/// copied; NaN points stay NaN in place, and is_dense says whether there are any. Nothing is removed, so
/// getRemovedIndices is always empty. The output may be the input. A caller's mistake is reported on PCL's console and
/// leaves an empty output.
///
/// Instantiated for PCL_XYZ_POINT_TYPES; for other types include impl/laplacian_smoothing.hpp.
template <typename PointT>
class LaplacianSmoothing : public pcl::Filter<PointT> {
 public:
  using Ptr = pcl::shared_ptr<LaplacianSmoothing<PointT>>;
  using ConstPtr = pcl::shared_ptr<const LaplacianSmoothing<PointT>>;
  using PointCloud = typename pcl::Filter<PointT>::PointCloud;
  using SearchPtr = typename pcl::search::Search<PointT>::Ptr;

  LaplacianSmoothing() { this->filter_name_ = "LaplacianSmoothing"; }

  /// Time step t >= 0 in units of the mean squared edge length, 1 unless set; see SmoothingOptions::time_step.
  void setTimeStep(double time_step) { time_step_ = time_step; }
  double getTimeStep() const { return time_step_; }

  /// Number of steps, at least 1, all with the Laplacian of the input; 1 unless set.
  void setIterations(int iterations) { iterations_ = iterations; }
  int getIterations() const { return iterations_; }

  /// Neighbours per point, at least 3; 30 unless set.
  void setKSearch(int k) { options_.neighbors = k; }
  int getKSearch() const { return options_.neighbors; }

  /// At most this many threads; 0 (default): one per processor.
  void setNumberOfThreads(unsigned int threads = 0) { options_.threads = static_cast<int>(threads); }
  unsigned int getNumberOfThreads() const { return static_cast<unsigned int>(options_.threads); }

  /// The search that finds the neighbours; null (default): the core, which also looks further if k are too few.
  /// filter() gives it the cloud and the indices of its finite points.
  void setSearchMethod(const SearchPtr& search) { search_ = search; }
  SearchPtr getSearchMethod() const { return search_; }

  /// Whether the core finds neighbours by the pixels of an organized input and cuts at depth jumps seen from its
  /// sensor_origin_; false unless set. A search method wins over it.
  void setOrganizedSearch(bool organized) { organized_ = organized; }
  bool getOrganizedSearch() const { return organized_; }

  /// What happened in the last filter(): odd points, edge lengths, costs.
  const Report& getReport() const { return report_; }

  using pcl::Filter<PointT>::getClassName;

 protected:
  using pcl::PCLBase<PointT>::input_;
  using pcl::PCLBase<PointT>::indices_;

  void applyFilter(PointCloud& output) override;

 private:
  double time_step_ = 1;
  int iterations_ = 1;
  CloudOptions options_{.keep_cover = false};
  SearchPtr search_;
  bool organized_ = false;
  Report report_;
};

}  // namespace tufted

#ifdef PCL_NO_PRECOMPILE
#include "tufted/pcl/impl/laplacian_smoothing.hpp"
#endif
