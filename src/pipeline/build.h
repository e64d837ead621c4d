#pragma once

#include "tufted/laplacian.h"

namespace tufted {

/// How L and M are made from the stars.
enum class CloudBuild {
  automatic,  ///< straight from the stars (src/direct) with Gluing::star and FaceOrder::angle, else by the whole cover
  whole_cover,  ///< always by the whole cover (src/cover), as for meshes; the reference of tests
};

/// Builds the Laplacian of a cloud, see pointCloudLaplacian().
/// @param[out] result replaced, in memory that it already has; undefined after an exception
void buildCloudLaplacian(const PointsRef& points, const CloudOptions& options, CloudBuild build, Laplacian& result);

/// Builds the Laplacian of a mesh, see meshLaplacian().
/// @param[out] result see buildCloudLaplacian()
void buildMeshLaplacian(const PointsRef& points, const TrianglesRef& triangles, const MeshOptions& options,
                        Laplacian& result);

}  // namespace tufted
