#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "algorithms/march_faces.h"

namespace tufted {
namespace {

/// Where a side of the cover lies in the distinct faces.
struct PlacedSide {
  int slot;   ///< slot of the side
  int start;  ///< slot of the corner that the side runs from
};

PlacedSide placedSide(const IntrinsicTriangulation& cover, const MarchFaces& faces, int side) {
  const int face = side / 3, k = side % 3;
  const auto& corners = cover.faces[face];
  std::array<double, 3> opposite;
  for (int i = 0; i < 3; ++i) opposite[i] = std::ldexp(cover.length[3 * face + (i + 1) % 3], -faces.exponent);
  // The order of the corners in distinctFace().
  std::array<int, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::pair(corners[a], opposite[a]) < std::pair(corners[b], opposite[b]); });
  const auto found = std::lower_bound(faces.faces.begin(), faces.faces.end(), distinctFace(corners, opposite),
                                      [](const MarchFace& a, const DistinctFace& b) {
                                        return std::tie(a.corners, a.opposite) < std::tie(b.corners, b.opposite);
                                      });
  const int first = 3 * static_cast<int>(found - faces.faces.begin());
  const auto slotOf = [&](int corner) {
    return first + static_cast<int>(std::find(order.begin(), order.end(), corner) - order.begin());
  };
  return {slotOf((k + 2) % 3), slotOf(k)};
}

/// Two sides that are glued to each other, and whether the corners after them are the same end of the edge.
struct JoinedSides {
  int side, other;
  bool is_same;
};

std::vector<JoinedSides> loopJoints(const IntrinsicTriangulation& cover, const MarchFaces& faces) {
  std::vector<JoinedSides> joints;
  for (int side = 0; side < std::ssize(cover.glue); ++side) {
    const auto& corners = cover.faces[side / 3];
    if (corners[side % 3] != corners[(side + 1) % 3]) continue;
    const PlacedSide here = placedSide(cover, faces, side), there = placedSide(cover, faces, cover.glue[side]);
    // The other side starts where this one ends.
    const bool starts_after = here.start == nextSide(here.slot), ends_after = there.start == nextSide(there.slot);
    joints.push_back({here.slot, there.slot, starts_after != ends_after});
  }
  std::sort(joints.begin(), joints.end(), [](const JoinedSides& a, const JoinedSides& b) { return a.side < b.side; });
  return joints;
}

}  // namespace

void setLoopEnds(const IntrinsicTriangulation& cover, MarchFaces& faces) {
  faces.loop_end.assign(3 * faces.faces.size(), -1);
  const std::vector<JoinedSides> joints = loopJoints(cover, faces);
  std::vector<int> reached;
  std::vector<int> apart;  // edges whose sides are not all glued to one another
  for (const JoinedSides& first : joints) {
    if (faces.loop_end[first.side] >= 0) continue;
    const int edge = faces.edgeAt(first.side);
    for (int i = faces.edge_offset[edge]; i < faces.edge_offset[edge + 1]; ++i)
      if (faces.loop_end[faces.edge_slots[i]] >= 0) apart.push_back(edge);
    faces.loop_end[first.side] = 0;
    reached = {first.side};
    while (!reached.empty()) {
      const int side = reached.back();
      reached.pop_back();
      auto joint = std::lower_bound(joints.begin(), joints.end(), side,
                                    [](const JoinedSides& a, int wanted) { return a.side < wanted; });
      for (; joint != joints.end() && joint->side == side; ++joint) {
        std::int8_t& end = faces.loop_end[joint->other];
        if (end >= 0) continue;
        end = joint->is_same ? faces.loop_end[side] : static_cast<std::int8_t>(1 - faces.loop_end[side]);
        reached.push_back(joint->other);
      }
    }
  }
  for (const int edge : apart)
    for (int i = faces.edge_offset[edge]; i < faces.edge_offset[edge + 1]; ++i)
      faces.loop_end[faces.edge_slots[i]] = -1;
}

}  // namespace tufted
