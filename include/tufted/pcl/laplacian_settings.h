#pragma once

#include <pcl/search/search.h>

#include "tufted/laplacian.h"

namespace tufted {

/// Settings that the PCL classes have in common: how they build the Laplacian of their input.
template <typename PointT>
class LaplacianSettings {
 public:
  /// A search method of PCL, or null.
  using SearchPtr = typename pcl::search::Search<PointT>::Ptr;

  /// Neighbours per point, at least 3; 30 by default.
  void setKSearch(int k) { options_.neighbors = k; }
  /// See setKSearch().
  int getKSearch() const { return options_.neighbors; }

  /// At most this many threads; 0 (default): one per processor.
  void setNumberOfThreads(unsigned int threads = 0) { options_.threads = static_cast<int>(threads); }
  /// See setNumberOfThreads().
  unsigned int getNumberOfThreads() const { return static_cast<unsigned int>(options_.threads); }

  /// The search that finds k neighbours; null (default): the library's own, which also takes more neighbours where k
  /// are too few. Its input is set to the cloud and the indices of its finite points.
  void setSearchMethod(const SearchPtr& search) { search_ = search; }
  /// See setSearchMethod().
  SearchPtr getSearchMethod() const { return search_; }

  /// Whether an organized input is a depth image seen from its sensor_origin_; false by default. Its pixels then
  /// replace k neighbours, no tree is built, and noise is measured along the line of sight. Recommended for depth
  /// cameras. Ignored with a search method.
  void setOrganizedSearch(bool organized) { organized_ = organized; }
  /// See setOrganizedSearch().
  bool getOrganizedSearch() const { return organized_; }

 protected:
  LaplacianSettings() = default;
  ~LaplacianSettings() = default;

  CloudOptions options_;    ///< options of the core, k and threads included
  SearchPtr search_;        ///< see setSearchMethod()
  bool organized_ = false;  ///< see setOrganizedSearch()
};

}  // namespace tufted
