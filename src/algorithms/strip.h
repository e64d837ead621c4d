#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "algorithms/march_faces.h"
#include "tufted/intrinsic_triangulation.h"

// Sequences of triangles, unfolded into the plane, and the shortest paths through them (docs/algorithm.md, section 18,
// paths).
namespace tufted {

/// Triangles from a corner of the first to a corner of the last, entered and left through sides. For slots see
/// MarchFaces.
struct Strip {
  struct Door {
    int leave, enter;  ///< slots of the edge in the face before and in the face after
    /// Slot in the face after of the corner that follows `leave` in the face before. It is stored because flips at rims
    /// leave edges from a vertex to itself, whose ends vertices do not distinguish.
    int partner;

    /// Slot in the face after of an end of the edge, by its slot in the face before.
    int after(int before) const { return before == nextSide(leave) ? partner : thirdSlot(enter, partner); }
    /// The inverse of after().
    int before(int after) const { return after == partner ? nextSide(leave) : previousSide(leave); }
  };
  int start;                ///< slot of the corner where the strip starts, in its first face
  int end;                  ///< slot of the corner where the strip ends, in its last face
  std::vector<Door> doors;  ///< empty: start and end are corners of one face

  /// Whether the strip is an edge, between two corners of one face.
  bool isEdge() const { return doors.empty(); }
};

/// Slot of one end of an edge, in the face of its side `enter`.
/// @param corner slot of that end in the face of the side `leave`
int cornerBeyond(const MarchFaces& faces, int corner, int leave, int enter);

/// The door from one side of an edge to another.
Strip::Door doorBetween(const MarchFaces& faces, int leave, int enter);

/// Drops the triangles at both ends of which a path only touches a corner of the door.
void trim(Strip& strip);

/// A straight piece of a path: from the corner where a strip starts to the one where it ends.
struct Segment {
  Strip strip;
  double length;
  /// Where each door is crossed: 0 at the end of the edge with the smaller number, 1 at the other.
  std::vector<double> crossings;
  /// Angles between the segment and the two sides of the corner at each end, in the first and last face: the side
  /// opposite the next corner, then the side opposite the previous one.
  std::array<double, 2> at_start, at_end;
};

template <class Segments>
double lengthOf(const Segments& segments) {
  double length = 0;
  for (const Segment& segment : segments) length += segment.length;
  return length;
}

/// Whether the ends of all edges of a face can be distinguished.
bool hasClearEdges(const MarchFaces& faces, int face);

/// The angle at a corner, radians.
double cornerAngle(const MarchFaces& faces, int slot);

/// The shortest path through a strip, as its straight pieces.
std::vector<Segment> straighten(const MarchFaces& faces, const Strip& strip);

}  // namespace tufted
