#pragma once

#include <cstdint>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// Options of orientedFrames().
struct OrientationOptions {
  /// Normals face this position, in the points' unit, each by itself. Null: normals agree with their neighbours'.
  /// Borrowed.
  const Eigen::Vector3d* viewpoint = nullptr;
  /// Which way the mean normal of an open component points, which has no outside: upwards, for an airborne scan. Null:
  /// as orientedFrames() says. Not used with a viewpoint. Borrowed.
  const Eigen::Vector3d* up = nullptr;
  Progress progress = {};  ///< called with the fraction of the points that are joined
};

/// What orientedFrames() did.
struct OrientationReport {
  std::int64_t components = 0;  ///< connected components, each oriented by itself; 0 towards a viewpoint
  /// Components that are open sheets: the mean of their normals is longer than 0.3, and over a closed surface it is 0.
  /// They have no outside, so that their sign is a convention; 0 towards a viewpoint.
  std::int64_t open = 0;
  std::int64_t turned = 0;  ///< active points whose normal had the other sign
  /// Neighbours whose normals disagree in the end: 0 where the surface has two sides; edges across which a Moebius
  /// strip, or noise, turned the sign. 0 towards a viewpoint.
  std::int64_t disagreeing_edges = 0;
  double seconds = 0;  ///< wall-clock
};

/// Frames whose normals have one sign on each component. Neighbours in L speak for having one sign, or for not having
/// it, by the cosine between their normals (as in Hoppe, DeRose, Duchamp, McDonald, Stuetzle: "Surface reconstruction
/// from unorganized points", 1992, Section 3.3); across creases one of them is first reflected in the plane between the
/// two points (Koenig, Gumhold: "Consistent propagation of normal orientations in point clouds", 2009). Sets of points
/// are joined, the surest pair first, by the sum of what all edges between them say (greedy additive edge contraction;
/// Keuper et al.: "Efficient decomposition of image and mesh graphs by lifted multicuts", 2015), so that single edges
/// that are wrong, of which a spanning tree would take some, do not matter. Each component then faces outwards: the
/// volume that its points and normals enclose is positive. Where it encloses none, as a plane does, the largest
/// coordinate of its mean normal is positive. An open sheet has no outside: it faces to where it bulges, or as a plane
/// where it hardly does, which `up` or a viewpoint may overrule. Bodies of some thousands of points that touch are one
/// component, but face outwards one by one, as far as neighbours that disagree show where they touch. Where the
/// triangles of a mesh agree (meshFrames() says Orientation::given) they say what is one side, and only whole
/// components turn.
///
/// Normals of a cloud that came without any are then fitted anew: by a quadratic through two rings of neighbours in L,
/// or by a plane through the ten nearest of these points, whichever leaves less variance. Tangents turn with their
/// normals: where a normal only changes its sign, cross(normal, tangent) stays. Coincident points have the frame of
/// their representative; other points that are not active keep theirs.
/// @param laplacian with positions; with frames, as that of a cloud has
/// @throws InvalidInput for arrays of the wrong size, a Laplacian without positions or frames, positions or frames of
/// active points that are not finite, a viewpoint that is not, or an `up` that is not or is 0
/// @throws Cancelled when `options.progress` returns false
Frames orientedFrames(const Laplacian& laplacian, const OrientationOptions& options = {},
                      OrientationReport* report = nullptr);
/// Orients the caller's frames, otherwise as above: for meshes those of meshFrames().
Frames orientedFrames(const Laplacian& laplacian, const Frames& frames, const OrientationOptions& options = {},
                      OrientationReport* report = nullptr);

}  // namespace tufted
