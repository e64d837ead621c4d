#pragma once

#include <pcl/surface/reconstruction.h>

#include <optional>
#include <string>
#include <vector>

#include "tufted/pcl/build_settings.h"

namespace tufted {

/// Selects triangles of the surface that form a mesh in which every edge has one or two triangles, see
/// surfaceTriangles(). They face the viewpoint with which the surface was built, if it is known; on a surface that was
/// given, setViewPoint() has no effect.
///
/// The surface is that of all finite points of the input, or the one of setSurface(). The cloud of the mesh is the
/// input with all its fields, NaN points too, so that corners are indices of the input; a point that takes no part is
/// in no triangle. With setIndices only triangles all of whose corners are named remain. A caller's mistake is reported
/// on PCL's console and leaves an empty mesh.
///
/// Instantiated for PCL_XYZ_POINT_TYPES; for other types include impl/surface_triangulation.hpp.
template <typename PointT>
class SurfaceTriangulation : public pcl::MeshConstruction<PointT>, public SurfaceSettings {
 public:
  /// Shared pointer, as PCL's classes have it.
  using Ptr = pcl::shared_ptr<SurfaceTriangulation<PointT>>;
  /// Shared pointer to const, as PCL's classes have it.
  using ConstPtr = pcl::shared_ptr<const SurfaceTriangulation<PointT>>;

  SurfaceTriangulation() { this->check_tree_ = false; }

  /// Neighbours per point, at least 3; 30 by default.
  void setKSearch(int k) { neighbors_ = k; }
  /// See setKSearch().
  int getKSearch() const { return getOptions().neighbors; }

  /// Makes a mesh.
  void reconstruct(pcl::PolygonMesh& output) override;
  /// Makes the triangles alone.
  void reconstruct(std::vector<pcl::Vertices>& polygons) override;

 protected:
  using pcl::MeshConstruction<PointT>::input_;
  using pcl::MeshConstruction<PointT>::indices_;
  using pcl::MeshConstruction<PointT>::tree_;

  /// The name of the class, "SurfaceTriangulation".
  std::string getClassName() const override { return "SurfaceTriangulation"; }
  /// Called by reconstruct().
  void performReconstruction(pcl::PolygonMesh& output) override;
  /// Called by reconstruct().
  void performReconstruction(std::vector<pcl::Vertices>& polygons) override { triangulate(polygons); }

 private:
  /// Fills `polygons` and reports mistakes.
  bool triangulate(std::vector<pcl::Vertices>& polygons);
};

}  // namespace tufted

#ifdef PCL_NO_PRECOMPILE
#include "tufted/pcl/impl/surface_triangulation.hpp"
#endif
