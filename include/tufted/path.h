#pragma once

#include <memory>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// A path over the surface.
struct SurfacePath {
  /// K x 3, in the points' unit: both ends, and where the path crosses an edge or passes a point. Positions are those
  /// that lengths are measured between, Laplacian::positions, linear along edges. Where edges were flipped their middle
  /// lies off the surface a little, and so do these.
  Points points;
  double length = 0;    ///< along the surface, in the points' unit
  int shortenings = 0;  ///< how often the path was led around the other side of a point
};

/// Shortest paths over the distinct faces of the tufted cover, prepared once and asked often. Queries may run side by
/// side.
///
/// A path follows edges down the distance from its start (see DistanceSolver). Then it is straightened: the triangles
/// that it runs through are unfolded into a plane, where the shortest way through them is found (Lee, Preparata 1984),
/// and where that turns at a point with less than half a circle on the other side, it is led around that side (Xin,
/// Wang: "Efficiently determining a locally exact shortest path on polyhedral surfaces", 2007). In the end it is
/// straight everywhere but at points with at least half a circle on each side, so that no path near it is shorter. That
/// is done from both ends, and the shorter path is taken. Any number of triangles may meet at an edge.
class PathSolver {
 public:
  /// Prepares the faces of a Laplacian's cover.
  /// @param laplacian must have its cover and positions; not needed after construction
  /// @param threads at most so many; 0: as many as the machine has
  /// @throws InvalidInput for arrays of the wrong size, or where there is no cover or are no positions
  /// @throws Cancelled when `progress` returns false
  explicit PathSolver(const Laplacian& laplacian, int threads = 0, const Progress& progress = {});

  /// The path between two points of the cloud or vertices of the mesh. One point of length 0 if they are the same, or
  /// coincide.
  /// @throws InvalidInput for an index out of range, or where no path leads
  /// @throws Cancelled when `progress` returns false
  SurfacePath path(int from, int to, const Progress& progress = {}) const;

  /// A moved-from solver may only be destroyed or assigned to.
  PathSolver(PathSolver&&) noexcept;
  /// A moved-from solver may only be destroyed or assigned to.
  PathSolver& operator=(PathSolver&&) noexcept;
  ~PathSolver();

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace tufted
