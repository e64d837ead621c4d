#pragma once

#include <cstdint>

// Variants of the method for comparison with the paper (Sharp and Crane 2020). Nobody else needs them.
namespace tufted {

/// Which edges of the union of stars become one before Algorithm 1 glues around them.
enum class Gluing {
  star,         ///< the two faces of p's star at a spoke are glued to each other only; link edges are shared by stars
  vertex_pair,  ///< all copies of an edge become one, as in the paper; eigenvalues stay 5 % off however large N is
};

/// Circular order of the faces around an edge (Section 5.4).
enum class FaceOrder {
  angle,   ///< ascending dihedral angle
  area,    ///< ascending area
  random,  ///< shuffled with `seed`
};

/// How the Delaunay stars are found. Both ways give the same triangles.
enum class Delaunay {
  star,  ///< angular sort and in-circle test around each point
  cgal,  ///< CGAL::Delaunay_triangulation_2 (GPL; needs TUFTED_WITH_GPL)
};

/// Member `paper` of CloudOptions and MeshOptions. Meshes have no stars: their edges are glued by vertex pairs, and
/// `gluing` and `delaunay` have no effect on them.
struct PaperOptions {
  Gluing gluing = Gluing::star;        ///< which edges of the stars become one
  FaceOrder order = FaceOrder::angle;  ///< circular order of the faces around an edge
  std::uint64_t seed = 0;              ///< for FaceOrder::random
  Delaunay delaunay = Delaunay::star;  ///< how the stars are found
};

}  // namespace tufted
