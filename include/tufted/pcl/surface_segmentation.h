#pragma once

#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>

#include <limits>
#include <string>
#include <vector>

#include "tufted/pcl/laplacian_settings.h"
#include "tufted/segments.h"

namespace tufted {

/// Cuts a cloud into segments: by default the connected components of its surface, which end at jumps, however near
/// they come to each other; with SegmentMethod::parts the things that stand on a table or touch each other; with
/// setNumberOfSegments() that many cells or clusters, see segments().
///
/// The surface is that of all finite points of the input, or the one of setSurface(). Segments hold points of the input
/// that setIndices names; a point that takes no part is in none. A caller's mistake is reported on PCL's console and
/// leaves an empty result.
///
/// Instantiated for PCL_XYZ_POINT_TYPES; for other types include impl/surface_segmentation.hpp.
template <typename PointT>
class SurfaceSegmentation : public pcl::PCLBase<PointT>, public LaplacianSettings<PointT> {
 public:
  /// Shared pointer, as PCL's classes have it.
  using Ptr = pcl::shared_ptr<SurfaceSegmentation<PointT>>;
  /// Shared pointer to const, as PCL's classes have it.
  using ConstPtr = pcl::shared_ptr<const SurfaceSegmentation<PointT>>;

  /// Number of segments, see SegmentOptions::count; 0 (default): one per connected component, or as many parts as there
  /// are, which take no other number.
  void setNumberOfSegments(int count) { count_ = count; }
  /// See setNumberOfSegments().
  int getNumberOfSegments() const { return count_; }

  /// How a number of segments is found; SegmentMethod::voronoi by default.
  void setMethod(SegmentMethod method) { method_ = method; }
  /// See setMethod().
  SegmentMethod getMethod() const { return method_; }

  /// See SegmentOptions::crease; for SegmentMethod::parts.
  void setCrease(double radians) { crease_ = radians; }
  /// See setCrease().
  double getCrease() const { return crease_; }

  /// Segments with fewer points are left out; 1 by default.
  void setMinClusterSize(int points) { least_ = points; }
  /// See setMinClusterSize().
  int getMinClusterSize() const { return least_; }

  /// Segments with more points are left out; no limit by default.
  void setMaxClusterSize(int points) { most_ = points; }
  /// See setMaxClusterSize().
  int getMaxClusterSize() const { return most_; }

  /// Finds the segments.
  /// @param[out] clusters in descending order of their size on the whole surface: components by number of points, parts
  /// by area; indices ascend if those of setIndices do
  void segment(std::vector<pcl::PointIndices>& clusters);

  /// The name of the class, "SurfaceSegmentation".
  const std::string& getClassName() const { return class_name_; }

 protected:
  using pcl::PCLBase<PointT>::input_;
  using pcl::PCLBase<PointT>::indices_;
  using LaplacianSettings<PointT>::search_;

 private:
  std::string class_name_ = "SurfaceSegmentation";
  int count_ = 0;
  SegmentMethod method_ = SegmentMethod::voronoi;
  double crease_ = SegmentOptions().crease;
  int least_ = 1, most_ = std::numeric_limits<int>::max();
};

}  // namespace tufted

#ifdef PCL_NO_PRECOMPILE
#include "tufted/pcl/impl/surface_segmentation.hpp"
#endif
