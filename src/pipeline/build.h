#pragma once

#include "tufted/laplacian.h"

namespace tufted {

/// How L and M are made from the stars.
enum class CloudBuild {
  automatic,  ///< from the stars themselves where they agree, with Gluing::star and FaceOrder::angle; else by the cover
  whole_cover,  ///< the plain way: the whole cover first, as for meshes. What tests compare with
};

/// See pointCloudLaplacian().
/// @param[out] result of no use after an exception; what it was before does not matter, but its memory is used again
void buildCloudLaplacian(const PointsRef& points, const CloudOptions& options, CloudBuild build, Laplacian& result);

/// See meshLaplacian().
/// @param[out] result as above
void buildMeshLaplacian(const PointsRef& points, const TrianglesRef& triangles, const MeshOptions& options,
                        Laplacian& result);

}  // namespace tufted
