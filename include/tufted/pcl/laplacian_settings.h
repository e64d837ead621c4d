#pragma once

#include <pcl/search/search.h>

#include "tufted/laplacian.h"

namespace tufted {

/// How the classes for users of PCL build the Laplacian of their input.
template <typename PointT>
class LaplacianSettings {
 public:
  /// Null, or a search of PCL.
  using SearchPtr = typename pcl::search::Search<PointT>::Ptr;

  /// Neighbours per point, at least 3; 30 unless set.
  void setKSearch(int k) { options_.neighbors = k; }
  /// See setKSearch().
  int getKSearch() const { return options_.neighbors; }

  /// At most this many threads; 0 (default): one per processor.
  void setNumberOfThreads(unsigned int threads = 0) { options_.threads = static_cast<int>(threads); }
  /// See setNumberOfThreads().
  unsigned int getNumberOfThreads() const { return static_cast<unsigned int>(options_.threads); }

  /// The search that finds the neighbours; null (default): the core, which also looks further if k are too few. It is
  /// given the cloud and the indices of its finite points.
  void setSearchMethod(const SearchPtr& search) { search_ = search; }
  /// See setSearchMethod().
  SearchPtr getSearchMethod() const { return search_; }

  /// Whether an organized input is a depth image seen from its sensor_origin_, whose pixels then take the place of k
  /// neighbours; false unless set. To be set for depth cameras: noise is told along the line of sight, and no tree is
  /// built. A search method wins over it.
  void setOrganizedSearch(bool organized) { organized_ = organized; }
  /// See setOrganizedSearch().
  bool getOrganizedSearch() const { return organized_; }

 protected:
  LaplacianSettings() = default;
  ~LaplacianSettings() = default;

  CloudOptions options_;    ///< of the core, k and threads included
  SearchPtr search_;        ///< see setSearchMethod()
  bool organized_ = false;  ///< see setOrganizedSearch()
};

}  // namespace tufted
