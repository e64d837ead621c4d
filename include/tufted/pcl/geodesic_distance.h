#pragma once

#include <pcl/pcl_base.h>
#include <pcl/point_types.h>

#include <memory>
#include <string>
#include <vector>

#include "tufted/distance.h"
#include "tufted/pcl/laplacian_settings.h"

namespace tufted {

/// Computes distances along the surface from some points of a cloud, see DistanceSolver.
///
/// The surface is that of all finite points of the input, or the one of setSurface(), for which what queries need is
/// prepared once. Results are those of the points that setIndices names. A caller's mistake is reported on PCL's
/// console and leaves an empty result.
///
/// Instantiated for PCL_XYZ_POINT_TYPES; for other types include impl/geodesic_distance.hpp.
template <typename PointT>
class GeodesicDistance : public pcl::PCLBase<PointT>, public LaplacianSettings<PointT> {
 public:
  /// Shared pointer, as PCL's classes have it.
  using Ptr = pcl::shared_ptr<GeodesicDistance<PointT>>;
  /// Shared pointer to const, as PCL's classes have it.
  using ConstPtr = pcl::shared_ptr<const GeodesicDistance<PointT>>;

  /// The points of the input, by index, from the nearest of which distances are measured. Those that take no part are
  /// ignored, but not all may be such.
  void setSources(const pcl::Indices& sources) { sources_.assign(sources.begin(), sources.end()); }

  /// Computes distances: the field `intensity`, in the unit of the points, infinite where no path leads and NaN at a
  /// point that takes no part.
  /// @param[out] output one point per index or, without indices, an organized cloud as the input; NaN positions are
  /// kept, and is_dense is false if any distance is NaN or infinite
  void compute(pcl::PointCloud<pcl::PointXYZI>& output);

  /// Finds the points within a radius of the sources along the surface, visiting these alone.
  /// @param radius > 0, in the unit of the points
  /// @param[out] found indices of points of the input, ascending
  /// @param[out] distances of these points
  /// @return number of points
  int radiusSearch(double radius, pcl::Indices& found, std::vector<float>& distances);

  /// The name of the class, "GeodesicDistance".
  const std::string& getClassName() const { return class_name_; }

 protected:
  using pcl::PCLBase<PointT>::input_;
  using pcl::PCLBase<PointT>::indices_;
  using LaplacianSettings<PointT>::search_;

 private:
  /// Calls `use` with the Laplacian and reports mistakes.
  bool run(const char* method, const std::function<void(const Laplacian&)>& use);

  std::string class_name_ = "GeodesicDistance";
  std::vector<int> sources_;
  std::shared_ptr<const Laplacian> prepared_;
  std::shared_ptr<const DistanceSolver> solver_;  // for prepared_
  int prepared_threads_ = 0;
};

}  // namespace tufted

#ifdef PCL_NO_PRECOMPILE
#include "tufted/pcl/impl/geodesic_distance.hpp"
#endif
