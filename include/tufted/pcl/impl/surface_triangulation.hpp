#pragma once

#include <cstdint>

#include "tufted/pcl/impl/cloud_laplacian.hpp"
#include "tufted/pcl/surface_triangulation.h"
#include "tufted/surface_triangles.h"

template <typename PointT>
void tufted::SurfaceTriangulation<PointT>::reconstruct(pcl::PolygonMesh& output) {
  output = {};
  // PCL's own method reads the header of the input before it looks whether there is one.
  if (this->initCompute()) pcl::MeshConstruction<PointT>::reconstruct(output);
}

template <typename PointT>
void tufted::SurfaceTriangulation<PointT>::reconstruct(std::vector<pcl::Vertices>& polygons) {
  pcl::MeshConstruction<PointT>::reconstruct(polygons);
}

template <typename PointT>
void tufted::SurfaceTriangulation<PointT>::performReconstruction(pcl::PolygonMesh& output) {
  if (!triangulate(output.polygons)) output = {};
}

template <typename PointT>
bool tufted::SurfaceTriangulation<PointT>::triangulate(std::vector<pcl::Vertices>& polygons) {
  polygons.clear();
  return detail::reported(getClassName(), "reconstruct", [&] {
    const detail::CloudInput input =
        detail::wholeInput<PointT>(input_, *indices_, hasGivenSurface() ? nullptr : tree_, getKSearch());
    const Triangles triangles = surfaceTriangles(surfaceOf(getClassName(), input));
    std::vector<std::uint8_t> is_asked(input_->size(), 0);
    for (const pcl::index_t i : *indices_) is_asked[i] = 1;
    polygons.reserve(static_cast<std::size_t>(triangles.rows()));
    for (const auto& corners : triangles.rowwise()) {
      if (is_asked[corners[0]] + is_asked[corners[1]] + is_asked[corners[2]] < 3) continue;
      pcl::Vertices& polygon = polygons.emplace_back();
      polygon.vertices.assign(corners.begin(), corners.end());
    }
  });
}

#define PCL_INSTANTIATE_SurfaceTriangulation(T) template class PCL_EXPORTS tufted::SurfaceTriangulation<T>;
