#pragma once

#include <Eigen/Core>
#include <vector>

#include "tufted/intrinsic_triangulation.h"
#include "tufted/types.h"

namespace tufted::bench {

/// The tufted cover of a mesh before flips (Algorithm 1), with the lengths between its points.
IntrinsicTriangulation gluedCover(const Points& points, const Triangles& triangles);

/// A part of an intrinsic edge, straight in one face of the glued cover.
struct EdgePart {
  int face;
  Eigen::Vector3d from, to;
};

/// An edge of the intrinsic Delaunay triangulation, traced over the faces of the glued cover.
struct IntrinsicEdge {
  bool is_flipped = false;  ///< whether it is no edge of the mesh
  std::vector<EdgePart> parts;
};

struct IntrinsicEdges {
  std::vector<IntrinsicEdge> edges;
  int flips = 0;
  double greatest_miss = 0;  ///< how far a traced edge ends from its vertex, relative to its length
};

/// Flips the cover to intrinsic Delaunay (Algorithm 2) while it records in which direction of the glued cover each edge
/// leaves its vertex (Sharp, Soliman and Crane 2019, "Navigating intrinsic triangulations"), and traces all edges.
/// @param cover of gluedCover(), whose triangles all have area
IntrinsicEdges intrinsicEdges(const IntrinsicTriangulation& cover, const Points& points);

}  // namespace tufted::bench
