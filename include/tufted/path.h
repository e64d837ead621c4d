#pragma once

#include <memory>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// A path on the surface.
struct SurfacePath {
  /// K x 3, in the points' unit: both ends, and the places where the path crosses an edge or passes a point,
  /// interpolated linearly along edges between Laplacian::positions. The middle of a flipped edge lies off the surface
  /// a little, and so do places on it.
  Points points;
  double length = 0;    ///< length along the surface, in the points' unit
  int shortenings = 0;  ///< how often the path was led around the other side of a point
};

/// Options of PathSolver.
struct PathOptions {
  int threads = 0;         ///< at most this many threads; 0: one per processor
  Progress progress = {};  ///< called while the faces are prepared
};

/// Shortest paths on the distinct faces of the tufted cover. Prepared once, queried often; queries may run in parallel.
///
/// A first path runs from the end down the distance to the start (see DistanceSolver). Then it is straightened: the
/// triangles that it crosses are unfolded into a plane, where the shortest way through them is found (Lee, Preparata
/// 1984); where that turns at a point with an angle below pi on the other side, the path is led around that side (Xin,
/// Wang: "Efficiently determining a locally exact shortest path on polyhedral surfaces", 2007). In the end it is
/// straight except at points with at least pi on each side, so no path near it is shorter. This is done from both ends,
/// and the shorter path is returned. Any number of triangles may meet at an edge.
class PathSolver {
 public:
  /// Prepares the faces of the cover.
  /// @param laplacian with its cover and positions; not needed after construction
  /// @throws InvalidInput for arrays of the wrong size, or a Laplacian without cover or positions
  /// @throws Cancelled when `options.progress` returns false
  explicit PathSolver(const Laplacian& laplacian, const PathOptions& options = {});

  /// Computes the path between two points of the cloud or vertices of the mesh; a single point and length 0 if they are
  /// the same or coincide.
  /// @param from,to indices of active points, or of points that coincide with one
  /// @throws InvalidInput for an index out of range, or where no path leads
  /// @throws Cancelled when `progress` returns false
  SurfacePath query(int from, int to, const Progress& progress = {}) const;

  /// Straightens a way through several points, which chooses one of the paths that pass handles, holes and hills on
  /// different sides: no path near the result is shorter. It need not pass the inner points. Between two points the way
  /// is a short path.
  /// @param points indices as in query(), at least two; of equal neighbours one counts
  /// @param is_closed whether the way goes back from the last point to the first: a loop, which keeps none of the
  /// points and may contract to a single one. `SurfacePath::points` then does not repeat the first point. A loop that
  /// turns at one point alone is not straightened there. A way may also keep a corner where triangles overlap, as those
  /// of clouds do here and there; those of surfaceTriangles(), built as a mesh, do not.
  /// @throws InvalidInput for fewer than two points, an index out of range, or where no path leads
  /// @throws Cancelled when `progress` returns false
  SurfacePath through(const std::vector<int>& points, bool is_closed, const Progress& progress = {}) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace tufted
