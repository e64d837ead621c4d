#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "algorithms/march_faces.h"

// One step of a straight line over triangles in space: through a face, or past a vertex (docs/algorithm.md, section 18,
// straight lines).
namespace tufted {

/// A face in the plane of a straight line, which is at the origin and runs along x.
struct FaceAhead {
  int face;
  std::array<Eigen::Vector2d, 3> corners;
  std::array<double, 3> weights;  ///< barycentric coordinates of the origin
  int entered = -1;  ///< slot of the side through which the line came; -1: it starts in the face or at a corner
};

/// Where a line leaves a face.
struct Leaving {
  int slot = -1;                       ///< of the side or corner
  bool is_corner = false;              ///< whether it meets a corner
  double distance = 0;                 ///< from the origin, >= 0
  std::array<double, 3> weights = {};  ///< barycentric coordinates of the place
};
Leaving leavingOf(const FaceAhead& ahead);

/// A corner of a face, from which a line turns from one of the two other corners to the other.
struct FanCorner {
  int slot, from, to;
};

/// The other slot of an edge of two faces; -1 for an edge of one or more than two.
int mateOf(const MarchFaces& faces, int slot);

/// The face in which a line starts at a corner.
/// @param angle between the side to `corner.from` and the line, radians
FaceAhead startAt(const MarchFaces& faces, const FanCorner& corner, double angle);

/// The face beyond a side.
FaceAhead crossSide(const MarchFaces& faces, const FaceAhead& before, const Leaving& leaving);

/// The face in which a line that meets a corner goes on, with half of the angle around the vertex on each side; nullopt
/// if faces do not lie all around, with exactly two at each edge.
/// @param open a slot of the edge where the faces end then
std::optional<FaceAhead> passVertex(const MarchFaces& faces, const FaceAhead& before, const Leaving& leaving,
                                    int& open);

}  // namespace tufted
