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

/// The result of a boolean operation by CGAL, with slivers along the cut, and its isotropic remeshing by CGAL, which
/// keeps creases. Two of its flat faces are handles.
struct BooleanSolid {
  std::string name;
  BooleanMesh cut, remeshed;
  Plane stays, moves;  ///< planes of the two handles, with no other points
};

/// A unit cube united with a ball at one of its sides, or without the ball; the handles are bottom and top.
/// @param seed for the position of the ball and the points of the cube
BooleanSolid cubeAndBall(bool is_union, std::uint64_t seed);
/// A unit cube with an inclined round post on it; the handles are the bottom and the end of the post.
/// @param seed for the direction of the post and the points
BooleanSolid cubeAndPost(std::uint64_t seed);

/// The points of a mesh in a plane.
std::vector<int> pointsIn(const Plane& plane, const Points& points);

/// Interpolates values at the points of a mesh, at the points of its surface nearest to `places`.
Points valuesAt(const BooleanMesh& mesh, const Points& values, const Points& places);

}  // namespace tufted::bench
