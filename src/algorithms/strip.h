#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "algorithms/march_faces.h"
#include "tufted/intrinsic_triangulation.h"

// Triangles one after the other, unfolded into the plane, and the shortest way through them.
namespace tufted {

/// Triangles from a corner of the first to a corner of the last, each entered and left through a side. A slot is a side
/// as in MarchFaces: 3 face + opposite corner.
struct Strip {
  struct Door {
    int leave, enter;  ///< the slots of one edge: in the face before and in the face after
    /// Slot of the corner in the face after that is the one after `leave` in the face before. The vertices do not tell
    /// where an edge joins one to itself, which flips at the rim of a surface leave behind.
    int partner;

    /// Where a corner of the edge lies in the face after, by its slot in the face before.
    int after(int before) const { return before == nextSide(leave) ? partner : thirdSlot(enter, partner); }
    /// The other way round.
    int before(int after) const { return after == partner ? nextSide(leave) : previousSide(leave); }
  };
  int start;                ///< slot of the corner where the strip starts, in its first face
  int end;                  ///< slot of the corner where the strip ends, in its last face
  std::vector<Door> doors;  ///< none: start and end are corners of one face

  /// Whether the strip is one edge: that between two corners of one face.
  bool isEdge() const { return doors.empty(); }
};

/// The corner at one end of an edge, in the face of its side `enter`.
/// @param corner that end in the face of the side `leave`
int cornerBeyond(const MarchFaces& faces, int corner, int leave, int enter);

/// The door from one side of an edge to another.
Strip::Door doorBetween(const MarchFaces& faces, int leave, int enter);

/// Drops the triangles at both ends that the way only enters to come to a corner of the door.
void trim(Strip& strip);

/// A straight piece of a path: from the corner where a strip starts to the one where it ends.
struct Segment {
  Strip strip;
  double length;
  /// For each door where it is crossed, from 0 at the end of the edge with the smaller number to 1.
  std::vector<double> crossings;
  /// The angles at both ends, in the first and in the last face, between the segment and the sides of that corner: the
  /// one opposite the next corner of the face, and the one opposite the corner after that.
  std::array<double, 2> at_start, at_end;
};

template <class Segments>
double lengthOf(const Segments& segments) {
  double length = 0;
  for (const Segment& segment : segments) length += segment.length;
  return length;
}

/// Whether the ends of all edges of a face can be told apart.
bool hasClearEdges(const MarchFaces& faces, int face);

/// The angle at a corner.
double cornerAngle(const MarchFaces& faces, int slot);

/// Splits the shortest way through a strip into its straight pieces.
std::vector<Segment> straighten(const MarchFaces& faces, const Strip& strip);

}  // namespace tufted
