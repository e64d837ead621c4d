#pragma once

#include "base/scaling.h"
#include "tufted/laplacian.h"

namespace tufted {

struct RankedCloud;
struct SurfaceStars;

/// How L and M are made from the stars.
enum class CloudBuild {
  automatic,  ///< straight from the stars (src/direct) with Gluing::star and FaceOrder::angle, else by the whole cover
  whole_cover,  ///< always by the whole cover (src/cover), as for meshes; the reference of tests
};

/// A part of a larger cloud that is built as the whole would be.
class CloudPart {
 public:
  explicit CloudPart(const Scaling& whole) : scaling_(whole) {}
  virtual ~CloudPart() = default;

  const Scaling& scaling() const { return scaling_; }
  /// Called when the stars are filtered, once or twice per build.
  virtual void takeStars(const SurfaceStars& built, const RankedCloud& cloud) = 0;

 private:
  Scaling scaling_;
};

/// Builds the Laplacian of a cloud, see pointCloudLaplacian().
/// @param[out] result replaced, in memory that it already has; undefined after an exception
/// @param part of which cloud the points, all of them usable, are a part; null: of none
void buildCloudLaplacian(const PointsRef& points, const CloudOptions& options, CloudBuild build, Laplacian& result,
                         CloudPart* part = nullptr);

/// Builds the Laplacian of a mesh, see meshLaplacian().
/// @param[out] result see buildCloudLaplacian()
void buildMeshLaplacian(const PointsRef& points, const TrianglesRef& triangles, const MeshOptions& options,
                        Laplacian& result);

}  // namespace tufted
