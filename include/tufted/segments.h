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
};

/// Options of segments().
struct SegmentOptions {
  SegmentMethod method = SegmentMethod::voronoi;  ///< how segments are found
  /// Number of segments, >= 1; empty: 8, or as many as possible. Ignored with `seeds`.
  std::optional<int> count = std::nullopt;
  /// For voronoi only: active points whose cells are the segments. Empty: `count` points, each as far as possible from
  /// those before it.
  std::vector<int> seeds = {};
  SolverOptions solver = {};  ///< how systems are solved
};

/// Segments of a surface.
struct Segments {
  /// N labels, 0 for the segment of the largest area; coincident points have that of their representative. -1 at
  /// isolated and non-finite points and on connected components that no segment reaches.
  std::vector<int> labels;
  VectorXd areas;          ///< area of each segment, descending; length^2
  std::vector<int> seeds;  ///< seed of each segment; empty with SegmentMethod::spectral
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
/// @param laplacian for voronoi with its cover and positions
/// @throws InvalidInput for a count below 1 or above the number of places or eigenvectors, a seed that is out of range,
/// not active or repeated, seeds with spectral, no active point, or a Laplacian without cover or positions for voronoi
/// @throws SolverFailure for the same reasons as DistanceSolver and spectrum()
/// @throws Cancelled when `options.solver.progress` returns false
Segments segments(const Laplacian& laplacian, const SegmentOptions& options = {});

}  // namespace tufted
