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
  /// How many, >= 1; none: 8, or as many as there can be. Ignored with `seeds`.
  std::optional<int> count = std::nullopt;
  /// Points whose Voronoi cells are the segments; those that are not active are refused. Empty: `count` points, each as
  /// far as possible from those before it.
  std::vector<int> seeds = {};
  SolverOptions solver = {};  ///< how systems are solved
};

/// Segments of a surface.
struct Segments {
  /// N labels, 0 for the segment of the largest area; coincident points have that of their representative. -1 at points
  /// that are isolated or not finite, and in connected components that no segment reaches.
  std::vector<int> labels;
  VectorXd areas;          ///< of each segment, descending; length^2
  std::vector<int> seeds;  ///< of each segment; empty with SegmentMethod::spectral
  double seconds = 0;      ///< wall-clock
};

/// Cuts a surface into segments.
///
/// Voronoi: a point belongs to the seed that is nearest along the surface (DistanceSolver). Without seeds, the first
/// one is the point farthest from the centre of the component of the largest area; each next one is the point farthest
/// from all seeds or, if a component has none yet and the diameter of a disc of its area is larger, the point of it
/// that is farthest from its centre.
///
/// Spectral: the rows of the first `count` eigenvectors, scaled to length 1, are clustered by k-means (Ng, Jordan,
/// Weiss: "On spectral clustering", 2002). Each component has the eigenvalue 0 once, so components are parted first.
/// @param laplacian with its cover and positions for Voronoi cells
/// @throws InvalidInput for a count below 1, or of eigenvectors that there are not, a seed that is out of range, not
/// active or given twice, no active point, or a Laplacian without cover or positions
/// @throws SolverFailure as DistanceSolver and spectrum()
/// @throws Cancelled when `options.solver.progress` returns false
Segments segments(const Laplacian& laplacian, const SegmentOptions& options = {});

}  // namespace tufted
