#pragma once

#include <cstdint>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// Options of orientedFrames().
struct OrientationOptions {
  /// A position that every normal shall face, in the unit of the points. Null: normals agree with their neighbours' and
  /// face outwards. Borrowed.
  const Eigen::Vector3d* viewpoint = nullptr;
  /// Direction that the mean normal of an open component shall have, since such a component has no outside; for an
  /// airborne scan upwards. Null: as orientedFrames() says. Not used with a viewpoint. Borrowed.
  const Eigen::Vector3d* up = nullptr;
  int threads = 0;         ///< at most this many threads for fitting normals; 0: one per processor
  Progress progress = {};  ///< called with the fraction of the points that are joined or fitted
};

/// Counts and timing of a call of orientedFrames().
struct OrientationReport {
  std::int64_t components = 0;  ///< connected components, each oriented separately; 0 with a viewpoint
  /// Components that are open sheets: their mean normal is longer than 0.3, while that of a closed surface is 0. They
  /// have no outside, so their sign is a convention; 0 with a viewpoint.
  std::int64_t open = 0;
  std::int64_t turned = 0;  ///< active points whose normal changed its sign
  /// Pairs of neighbours whose normals disagree in the end: 0 on a surface with two sides; on a Moebius strip, or where
  /// noise turned a sign, the edges across which the sign changes. 0 with a viewpoint.
  std::int64_t disagreeing_edges = 0;
  double seconds = 0;  ///< wall-clock
};

/// Turns the normals of a Laplacian's frames so that they have one sign on each component.
///
/// Two neighbours in L vote for equal or for opposite signs with the cosine between their normals (as in Hoppe, DeRose,
/// Duchamp, McDonald, Stuetzle: "Surface reconstruction from unorganized points", 1992, Section 3.3). Across a crease
/// one normal is first reflected in the plane midway between the two points (Koenig, Gumhold: "Consistent propagation
/// of normal orientations in point clouds", 2009). Sets of points are merged, the most certain pair of sets first, by
/// the sum of the votes of all edges between them (greedy additive edge contraction; Keuper et al.: "Efficient
/// decomposition of image and mesh graphs by lifted multicuts", 2015). So single wrong edges, which a spanning tree
/// might use, do not matter.
///
/// Each component then faces outwards: the volume enclosed by its points and normals is positive. If it encloses none,
/// as a plane, the largest coordinate of its mean normal is positive. An open sheet faces the way it bulges or, if it
/// hardly does, as a plane, unless `up` or a viewpoint decides. Bodies of some thousands of points that touch are one
/// component but face outwards separately, if neighbours that disagree show where they touch. If the triangles of a
/// mesh are oriented consistently (Orientation::given of meshFrames()), only whole components are turned.
///
/// Normals of a cloud that were not given by the caller are then fitted anew, by a quadratic through two rings of
/// neighbours in L or by a plane through the ten nearest of these points, whichever leaves less variance. Tangents turn
/// with their normals: where a normal only changes its sign, cross(normal, tangent) stays. Coincident points have the
/// frame of their representative; other points that are not active keep theirs.
/// @param laplacian with positions, and with frames, as a cloud's
/// @return frames of N points, with Orientation::viewpoint or Orientation::consistent
/// @throws InvalidInput for arrays of the wrong size, a Laplacian without positions or frames, active points whose
/// positions or frames are not finite, a viewpoint that is not finite, or an `up` that is 0 or not finite
/// @throws Cancelled when `options.progress` returns false
Frames orientedFrames(const Laplacian& laplacian, const OrientationOptions& options = {},
                      OrientationReport* report = nullptr);
/// Turns the normals of the caller's frames, for meshes those of meshFrames(); otherwise as without.
Frames orientedFrames(const Laplacian& laplacian, const Frames& frames, const OrientationOptions& options = {},
                      OrientationReport* report = nullptr);

}  // namespace tufted
