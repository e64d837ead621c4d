#pragma once

#include <pcl/pcl_base.h>
#include <pcl/search/search.h>

#include <string>

#include "tufted/laplacian.h"

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
class LaplacianEstimation : public pcl::PCLBase<PointT> {
 public:
  using Ptr = pcl::shared_ptr<LaplacianEstimation<PointT>>;
  using ConstPtr = pcl::shared_ptr<const LaplacianEstimation<PointT>>;
  using SearchPtr = typename pcl::search::Search<PointT>::Ptr;

  /// Builds the Laplacian of the input cloud; `result` is overwritten, with 0 rows if that failed.
  void compute(Laplacian& result);

  /// Neighbours per point, at least 3; 30 unless set.
  void setKSearch(int k) { options_.neighbors = k; }
  int getKSearch() const { return options_.neighbors; }

  /// At most this many threads; 0 (default): one per processor.
  void setNumberOfThreads(unsigned int threads = 0) { options_.threads = static_cast<int>(threads); }
  unsigned int getNumberOfThreads() const { return static_cast<unsigned int>(options_.threads); }

  /// The search that finds the neighbours; null (default): the core, which also looks further if k are too few.
  /// compute() gives it the cloud and the finite ones of its indices.
  void setSearchMethod(const SearchPtr& search) { search_ = search; }
  SearchPtr getSearchMethod() const { return search_; }

  /// Whether the core finds neighbours by the pixels of an organized input and cuts at depth jumps seen from its
  /// sensor_origin_; false unless set. A search method wins over it.
  void setOrganizedSearch(bool organized) { organized_ = organized; }
  bool getOrganizedSearch() const { return organized_; }

  /// All options of the core, k and threads included. What they borrow (normals, neighborhoods, structure: one row per
  /// index) must live until compute() is done; a search method or an organized search wins over neighborhoods and
  /// structure.
  void setOptions(const CloudOptions& options) { options_ = options; }
  const CloudOptions& getOptions() const { return options_; }

  const std::string& getClassName() const { return class_name_; }

 protected:
  using pcl::PCLBase<PointT>::input_;
  using pcl::PCLBase<PointT>::indices_;

 private:
  std::string class_name_ = "LaplacianEstimation";
  CloudOptions options_;
  SearchPtr search_;
  bool organized_ = false;
};

}  // namespace tufted

#ifdef PCL_NO_PRECOMPILE
#include "tufted/pcl/impl/laplacian_estimation.hpp"
#endif
