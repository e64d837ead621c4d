#include "algorithms/straight_way.h"

#include <cmath>
#include <vector>

#include "algorithms/apex.h"
#include "base/cross.h"

namespace tufted {
namespace {

using Eigen::Vector2d;

/// A piece ends at the target if it misses it by less than this part of its length.
constexpr double at_target = 1e-9;

/// A side through which the line leaves a face, in the plane.
struct Exit {
  int leave;  ///< slot of the side
  Vector2d left, right;
  int left_slot, right_slot;  ///< slots of the corners at its ends
  int tried = 0;              ///< number of faces beyond it that were tried
};

}  // namespace

std::optional<Strip> straightWay(const MarchFaces& faces, int start, double angle, double length, int target,
                                 int most_faces) {
  const auto areaOf = [&](int slot) { return faces.faces[slot / 3].doubleArea(); };
  const int second = nextSide(start), third = previousSide(start);
  const Vector2d end = length * Vector2d(std::cos(angle), std::sin(angle)), right(faces.lengthAt(third), 0);
  const Vector2d left =
      apexLeftOf(Vector2d::Zero(), right, faces.lengthAt(second), faces.lengthAt(start), areaOf(start));
  Strip strip{start, start, {}};
  std::vector<Exit> exits = {{start, left, right, third, second}};  // one more than doors
  while (!exits.empty()) {
    Exit& exit = exits.back();
    const int edge = faces.edgeAt(exit.leave), at = faces.edge_offset[edge] + exit.tried++;
    const bool ends_before = cross(exit.left - exit.right, end - exit.right) > 0;
    if (ends_before || at == faces.edge_offset[edge + 1]) {
      exits.pop_back();
      if (!exits.empty()) strip.doors.pop_back();
      continue;
    }
    const int enter = faces.edge_slots[at];
    if (enter == exit.leave || !hasClearEdges(faces, enter / 3)) continue;
    if (most_faces-- == 0) return {};
    const Strip::Door door = doorBetween(faces, exit.leave, enter);
    const int left_slot = door.after(exit.left_slot), right_slot = door.after(exit.right_slot);
    const Vector2d apex =
        apexLeftOf(exit.left, exit.right, faces.lengthAt(right_slot), faces.lengthAt(left_slot), areaOf(enter));
    strip.doors.push_back(door);
    if (faces.vertexAt(enter) == target && (apex - end).norm() <= at_target * length) {
      strip.end = enter;
      return strip;
    }
    const bool passes_on_right = cross(end, apex) > 0;
    exits.push_back(passes_on_right ? Exit{left_slot, apex, exit.right, enter, right_slot}
                                    : Exit{right_slot, exit.left, apex, left_slot, enter});
  }
  return {};
}

}  // namespace tufted
