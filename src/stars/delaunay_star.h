#pragma once

#include "base/buffer.h"
#include "stars/predicates.h"

namespace tufted {

/// The triangles around p in the Delaunay triangulation of p and its projected neighbours.
struct DelaunayStar {
  Buffer<PlanarPoint> link;  ///< counterclockwise; triangle i is (p, link[i], link[i + 1])
  bool closed = false;       ///< the last link vertex is joined to the first; else p is a boundary point

  /// Circumradius of each triangle; infinite where it is too flat for a double.
  Buffer<double> radius;

  int triangles() const { return static_cast<int>(link.size()) - (closed || link.empty() ? 0 : 1); }
  const PlanarPoint& after(int i) const { return link[i + 1 == static_cast<int>(link.size()) ? 0 : i + 1]; }
  double largestCircumradius() const;
};

/// The circumradius of the triangle (origin, a, b), counterclockwise; infinite where it is too flat for a double.
double circumradius(const PlanarPoint& a, const PlanarPoint& b);

/// A planar point with a number that grows with the angle of its direction.
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

/// The star of the origin among `candidates`, which are given by ascending distance in space; of those that project to
/// one place the first counts, and one that projects onto p has no direction and is dropped. A gap of pi or more
/// between neighbouring directions leaves the star open.
///
/// Cocircular neighbours are decided by rank: of the two diagonals (p, b) and (a, c) the one with the smallest vertex
/// stands, which is the same choice in the stars of all four points.
void delaunayStar(const Buffer<PlanarPoint>& candidates, int p, StarScratch& scratch, DelaunayStar& star);

/// Same triangles by CGAL::Delaunay_triangulation_2. Only with TUFTED_WITH_GPL.
void delaunayStarCgal(const Buffer<PlanarPoint>& candidates, int p, StarScratch& scratch, DelaunayStar& star);

/// The star among `scratch.chosen` alone (reordered here): sort by angle, then remove link vertices by the in-circle
/// test until stable.
void wrapChosen(int p, StarScratch& scratch, DelaunayStar& star);

}  // namespace tufted
