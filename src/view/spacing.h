#pragma once

#include <vector>

#include "tufted/view/scene.h"
#include "view/projection.h"

namespace tufted::view {

/// The discs as which points are drawn.
struct Discs {
  /// N radii in normalised coordinates, so wide that neighbouring discs leave no hole in the surface, but at most a
  /// share of the scene and a few times the median. Discs of points that lie on no surface, because the normals around
  /// them disagree or the value in the first field is NaN, are at most as large as the median.
  std::vector<float> radii;
  /// Radius within which a disc hides what is behind it, so that sparse points do not hide dense ones.
  float core = 0;
  /// N unit normals of the surface, of either sign; 0 where there is none.
  std::vector<Eigen::Vector3f> normals;
  /// The finite points in Morton order, so that points drawn one after another are near in memory.
  std::vector<int> order;
};

Discs discsOf(const Scene& scene, const NormalizedPoints& points, int threads);

/// Chooses `most` finite points of a larger cloud evenly along the Morton curve, so that dense and sparse parts are
/// thinned alike, and all sources of distances.
/// @return ascending indices; empty if all points are kept: of meshes, of at most `most` points, or if `most` is 0
std::vector<int> thinned(const Scene& scene, Eigen::Index most);

/// The scene of some points of a cloud.
Scene sceneOfRows(const Scene& scene, const std::vector<int>& rows);

}  // namespace tufted::view
