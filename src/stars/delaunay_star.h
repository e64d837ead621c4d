#pragma once

#include "base/buffer.h"
#include "stars/predicates.h"

namespace tufted {

/// The triangles around p in the Delaunay triangulation of p and its projected neighbours.
struct DelaunayStar {
  Buffer<PlanarPoint> link;  ///< counterclockwise; triangle i is (p, link[i], link[i + 1]), cyclically
  bool closed = false;       ///< whether the last link vertex has a triangle with the first; else p is a boundary point

  /// Circumradius of each triangle; infinite if it is too flat for a double.
  Buffer<double> radius;

  int triangles() const { return static_cast<int>(link.size()) - (closed || link.empty() ? 0 : 1); }
  const PlanarPoint& after(int i) const { return link[i + 1 == static_cast<int>(link.size()) ? 0 : i + 1]; }
  double largestCircumradius() const;
};

/// The circumradius of the counterclockwise triangle (origin, a, b); infinite if it is too flat for a double.
double circumradius(const PlanarPoint& a, const PlanarPoint& b);

/// A planar point with a key that increases with the angle of its direction.
struct Directed {
  double key;
  PlanarPoint point;
};

/// Memory that one worker reuses from star to star.
struct StarScratch {
  Buffer<PlanarPoint> chosen;
  Buffer<int> next, previous;
  Buffer<Directed> directed, sorted;
};

/// The star of the origin among `candidates`, in ascending order of distance in space (section 6 of docs/algorithm.md).
/// If several candidates project to one position, the first is used; one that projects onto p is dropped. A gap of pi
/// or more between neighbouring directions leaves the star open.
///
/// If p, a, b and c are cocircular, the diagonal (p, b) or (a, c) that has the point of smallest rank is an edge, which
/// is the same choice in the stars of all four points.
/// @param p rank of the origin
void delaunayStar(const Buffer<PlanarPoint>& candidates, int p, StarScratch& scratch, DelaunayStar& star);

/// Finds the star of delaunayStar() by CGAL::Delaunay_triangulation_2. Only with TUFTED_WITH_GPL.
void delaunayStarCgal(const Buffer<PlanarPoint>& candidates, int p, StarScratch& scratch, DelaunayStar& star);

/// The star among `scratch.chosen`, which is reordered: sorts by angle, then removes link vertices by the in-circle
/// test until none is cut off.
void wrapChosen(int p, StarScratch& scratch, DelaunayStar& star);

}  // namespace tufted
