#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "tufted/types.h"

namespace tufted::bench {

using Plane = Eigen::Hyperplane<double, 3>;

struct BooleanMesh {
  Points points;
  Triangles triangles;
};

/// A solid as CGAL's boolean operation leaves it, with slivers along the cut, and CGAL's isotropic remeshing of that,
/// which keeps its creases. Two of its flat faces are handles.
struct BooleanSolid {
  std::string name;
  BooleanMesh cut, remeshed;
  Plane stays, moves;  ///< of the handles; no other points lie there
};

/// A unit cube united with a ball at one of its sides, or without the ball; the handles are bottom and top.
/// @param seed of the ball's place and of the cube's points
BooleanSolid cubeAndBall(bool is_union, std::uint64_t seed);
/// A unit cube with an inclined round post on it; the handles are the bottom and the end of the post.
/// @param seed of the post's direction and of points
BooleanSolid cubeAndPost(std::uint64_t seed);

/// The points of a mesh in a plane.
std::vector<int> pointsIn(const Plane& plane, const Points& points);

/// Values at the points of a mesh, interpolated at the places of its surface that are nearest to `places`.
Points valuesAt(const BooleanMesh& mesh, const Points& values, const Points& places);

}  // namespace tufted::bench
