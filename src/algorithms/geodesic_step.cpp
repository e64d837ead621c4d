// Straightest geodesics (Polthier, Schmies 1998).
#include "algorithms/geodesic_step.h"

#include <algorithm>
#include <cmath>

#include "algorithms/apex.h"
#include "algorithms/strip.h"

namespace tufted {
namespace {

using Eigen::Vector2d;

/// A line meets a corner if it passes it within this part of the face's size: rounding moves lines by some 1e-16 for
/// each face that they have crossed.
constexpr double on_corner = 1e-9;

double sizeOf(const FaceAhead& ahead) {
  double size = 0;
  for (int k = 0; k < 3; ++k) size = std::max(size, (ahead.corners[k] - ahead.corners[(k + 1) % 3]).norm());
  return size;
}

}  // namespace

Leaving leavingOf(const FaceAhead& ahead) {
  Leaving best;
  const double near = on_corner * sizeOf(ahead);
  for (int k = 0; k < 3; ++k) {
    const Vector2d& corner = ahead.corners[k];
    const int slot = 3 * ahead.face + k;
    const bool is_ahead = ahead.entered < 0 ? corner.x() > 0 : ahead.entered == slot;
    if (!is_ahead || !(std::abs(corner.y()) <= near) || (best.slot >= 0 && best.distance <= corner.x())) continue;
    best = {slot, true, std::max(corner.x(), 0.0), {}};
    best.weights[k] = 1;
  }
  if (best.slot >= 0) return best;
  // The side that the line crosses last: it crosses another one where it starts on it.
  for (int k = 0; k < 3; ++k) {
    const int one = (k + 1) % 3, other = (k + 2) % 3;
    const Vector2d &a = ahead.corners[one], &b = ahead.corners[other];
    if (ahead.entered == 3 * ahead.face + k || (a.y() > 0) == (b.y() > 0)) continue;
    const double share = a.y() / (a.y() - b.y());
    const double distance = std::max(a.x() + share * (b.x() - a.x()), 0.0);
    if (best.slot >= 0 && best.distance >= distance) continue;
    best = {3 * ahead.face + k, false, distance, {}};
    best.weights[one] = 1 - share;
    best.weights[other] = share;
  }
  if (best.slot >= 0) return best;
  // A line that starts on a side, beside the face by rounding.
  const int farthest = ahead.corners[0].x() > std::max(ahead.corners[1].x(), ahead.corners[2].x()) ? 0
                       : ahead.corners[1].x() > ahead.corners[2].x()                               ? 1
                                                                                                   : 2;
  best = {3 * ahead.face + farthest, true, std::max(ahead.corners[farthest].x(), 0.0), {}};
  best.weights[farthest] = 1;
  return best;
}

int mateOf(const MarchFaces& faces, int slot) {
  const int edge = faces.edgeAt(slot), first = faces.edge_offset[edge];
  if (faces.edge_offset[edge + 1] - first != 2) return -1;
  return faces.edge_slots[first] == slot ? faces.edge_slots[first + 1] : faces.edge_slots[first];
}

FaceAhead startAt(const MarchFaces& faces, const FanCorner& corner, double angle) {
  const double rest = cornerAngle(faces, corner.slot) - angle;
  const double to_from = faces.lengthAt(corner.to), to_to = faces.lengthAt(corner.from);
  FaceAhead ahead{corner.slot / 3, {}, {}};
  ahead.weights[corner.slot % 3] = 1;
  ahead.corners[corner.slot % 3] = Vector2d::Zero();
  ahead.corners[corner.from % 3] = to_from * Vector2d(std::cos(angle), -std::sin(angle));
  ahead.corners[corner.to % 3] = to_to * Vector2d(std::cos(rest), std::sin(rest));
  return ahead;
}

FaceAhead crossSide(const MarchFaces& faces, const FaceAhead& before, const Leaving& leaving) {
  const Strip::Door door = doorBetween(faces, leaving.slot, mateOf(faces, leaving.slot));
  int left = nextSide(leaving.slot), right = previousSide(leaving.slot);
  if (before.corners[left % 3].y() <= 0) std::swap(left, right);
  const auto shifted = [&](int slot) -> Vector2d { return before.corners[slot % 3] - Vector2d(leaving.distance, 0); };
  const Vector2d at_left = shifted(left), at_right = shifted(right);
  FaceAhead ahead{door.enter / 3, {}, {}, door.enter};
  ahead.weights[door.after(left) % 3] = leaving.weights[left % 3];
  ahead.weights[door.after(right) % 3] = leaving.weights[right % 3];
  left = door.after(left);
  right = door.after(right);
  ahead.corners[left % 3] = at_left;
  ahead.corners[right % 3] = at_right;
  ahead.corners[door.enter % 3] =
      apexLeftOf(at_left, at_right, faces.lengthAt(right), faces.lengthAt(left), faces.faces[ahead.face].doubleArea());
  return ahead;
}

std::optional<FaceAhead> passVertex(const MarchFaces& faces, const FaceAhead& before, const Leaving& leaving,
                                    int& open) {
  // Turning counterclockwise from the way back, which runs along -x, the line comes to the lower corner first.
  int upper = nextSide(leaving.slot), lower = previousSide(leaving.slot);
  if (before.corners[upper % 3].y() < before.corners[lower % 3].y()) std::swap(upper, lower);
  const Vector2d to_upper = before.corners[upper % 3] - before.corners[leaving.slot % 3];
  const double back = std::clamp(std::atan2(to_upper.y(), -to_upper.x()), 0.0, cornerAngle(faces, leaving.slot));
  std::vector<FanCorner> fan = {{leaving.slot, upper, lower}};
  double total = 0;
  while (true) {
    const FanCorner last = fan.back();
    total += cornerAngle(faces, last.slot);
    open = last.from;  // the side between the vertex and `to`
    const int enter = mateOf(faces, last.from);
    if (enter < 0) return {};
    const Strip::Door door = doorBetween(faces, last.from, enter);
    const FanCorner next = {door.after(last.slot), door.after(last.to), enter};
    if (next.slot == leaving.slot) break;
    fan.push_back(next);
  }
  double angle = total > 0 ? std::fmod(back + total / 2, total) : 0;  // from the upper side
  for (const FanCorner& corner : fan) {
    const double width = cornerAngle(faces, corner.slot);
    if (angle <= width || corner.slot == fan.back().slot) return startAt(faces, corner, std::min(angle, width));
    angle -= width;
  }
  return {};
}

}  // namespace tufted
