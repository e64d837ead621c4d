#pragma once

#include <pcl/search/search.h>

#include "tufted/pcl/build_settings.h"

namespace tufted {

/// Adds to the settings those that classes derived from pcl::PCLBase lack.
/// @tparam Base BuildSettings or SurfaceSettings
template <typename PointT, class Base = SurfaceSettings>
class LaplacianSettings : public Base {
 public:
  /// A search method of PCL, or null.
  using SearchPtr = typename pcl::search::Search<PointT>::Ptr;

  /// Neighbours per point, at least 3; 30 by default.
  void setKSearch(int k) { this->neighbors_ = k; }
  /// See setKSearch().
  int getKSearch() const { return this->getOptions().neighbors; }

  /// The search that finds k neighbours; null (default): the library's own, which also takes more neighbours where k
  /// are too few. Its input is set to the cloud and the indices of its finite points.
  void setSearchMethod(const SearchPtr& search) { search_ = search; }
  /// See setSearchMethod().
  SearchPtr getSearchMethod() const { return search_; }

 protected:
  LaplacianSettings() = default;
  ~LaplacianSettings() = default;

  SearchPtr search_;  ///< see setSearchMethod()
};

}  // namespace tufted
