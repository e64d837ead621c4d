#pragma once

#include "tufted/laplacian.h"

namespace tufted {

/// How L and M are made from the stars.
enum class CloudBuild {
  automatic,  ///< from the stars themselves where they agree, with Gluing::star and FaceOrder::angle; else by the cover
  whole_cover,  ///< the plain way: the whole cover first, as for meshes. What tests compare with
};

/// See pointCloudLaplacian().
Laplacian buildCloudLaplacian(const Points& points, const CloudOptions& options, CloudBuild build);

}  // namespace tufted
