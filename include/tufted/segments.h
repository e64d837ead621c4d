#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// How a surface is cut into segments.
enum class SegmentMethod : std::uint8_t {
  voronoi,   ///< geodesic Voronoi cells of seeds: compact cells of similar size
  spectral,  ///< clusters of points in the first eigenvectors: parts that narrow necks join
  parts,     ///< parts between concave creases, as of things that stand on a table or touch each other
};

/// Options of segments().
struct SegmentOptions {
  SegmentMethod method = SegmentMethod::voronoi;  ///< how segments are found
  /// Number of segments, >= 1; empty: 8, or as many as possible. Ignored with `seeds`. Not for parts, which are as many
  /// as there are.
  std::optional<int> count = std::nullopt;
  /// For voronoi only: active points whose cells are the segments. Empty: `count` points, each as far as possible from
  /// those before it.
  std::vector<int> seeds = {};
  /// For parts only: where the normal turns inwards by more than this many radians over one spacing, the square root of
  /// the area of the point, there is a crease; > 0. 0.03 to 0.1 find the same things on tables in five depth images. A
  /// hollow of fewer than 1 / crease spacings in radius counts as a crease.
  double crease = 0.08;
  /// For parts only: sets of fewer points between creases go to the parts around them; >= 1.
  int least_points = 100;
  SolverOptions solver = {};  ///< how systems are solved; for parts threads and progress only
};

/// Segments of a surface.
struct Segments {
  /// N labels, 0 for the segment of the largest area; coincident points have that of their representative. -1 at
  /// isolated and non-finite points and on connected components that no segment reaches.
  std::vector<int> labels;
  VectorXd areas;          ///< area of each segment, descending; length^2
  std::vector<int> seeds;  ///< seed of each segment; empty with SegmentMethod::spectral and SegmentMethod::parts
  double seconds = 0;      ///< wall-clock
};

/// Cuts a surface into segments.
///
/// Voronoi: a point belongs to the seed that is nearest along the surface (DistanceSolver). Without given seeds, the
/// first one is the point farthest from the centre of the component of the largest area. Each next one is the point
/// farthest from all seeds, or the point of a component without seed farthest from its centre, if the diameter of a
/// disc of its area exceeds that distance.
///
/// Spectral: the rows of the first `count` eigenvectors, scaled to length 1, are clustered by k-means (Ng, Jordan,
/// Weiss: "On spectral clustering", 2002). Each component has the eigenvalue 0 once, so components are separated first.
///
/// Parts: points where the normal turns inwards faster than `crease` are taken out. The connected sets of at least
/// `least_points` that remain are the parts, and grow over the others, ring by ring. So parts end at concave creases,
/// as in Stein, Schoeler, Papon, Woergoetter: "Object partitioning using local convexity", 2014, and where the surface
/// ends. The shape operator at a point is the symmetric matrix that fits the differences of normals over its neighbours
/// in L best; normals are those of frames whose signs agree, and are found by orientedFrames() where they do not.
/// @param laplacian for voronoi with its cover and positions, for parts with positions and, as a cloud's, frames
/// @throws InvalidInput for a count below 1 or above the number of places or eigenvectors, a seed that is out of range,
/// not active or repeated, seeds with spectral, seeds or a count with parts, `crease` or `least_points` out of range,
/// no active point, a Laplacian without cover or positions for voronoi, or without positions or frames for parts
/// @throws SolverFailure for the same reasons as DistanceSolver and spectrum()
/// @throws Cancelled when `options.solver.progress` returns false
Segments segments(const Laplacian& laplacian, const SegmentOptions& options = {});
/// Cuts a surface into segments, as without frames.
/// @param frames N x 3 each, used for parts instead of those of the Laplacian; for meshes those of meshFrames()
Segments segments(const Laplacian& laplacian, const Frames& frames, const SegmentOptions& options = {});

}  // namespace tufted
