// The shortest path through unfolded triangles (Lee, Preparata: "Euclidean shortest paths in the presence of
// rectilinear barriers", 1984).
#include "algorithms/strip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "algorithms/apex.h"
#include "base/cross.h"

namespace tufted {
namespace {

using Eigen::Vector2d;

/// A door in the plane, with its ends as seen in the direction of the path.
struct OpenDoor {
  Vector2d left, right;
  int left_before, right_before;  ///< slots of these ends in the face before
  int left_after, right_after;    ///< slots in the face after
};

struct Layout {
  Vector2d start, end;
  std::vector<OpenDoor> doors;

  /// An end of a door; after the last door, the end of the strip.
  const Vector2d& endOf(std::size_t door, bool is_left) const {
    return door == doors.size() ? end : is_left ? doors[door].left : doors[door].right;
  }
};

/// Unfolds a strip into the plane, its start at 0.
Layout layOut(const MarchFaces& faces, const Strip& strip) {
  Layout layout;
  const auto areaOf = [&](int slot) { return faces.faces[slot / 3].doubleArea(); };
  // The first face counterclockwise from its start.
  const int second = nextSide(strip.start), third = previousSide(strip.start);
  std::array<Vector2d, 3> corners;  // by corner of the face
  corners[strip.start % 3] = Vector2d::Zero();
  corners[second % 3] = Vector2d(faces.lengthAt(third), 0);
  corners[third % 3] = apexLeftOf(corners[strip.start % 3], corners[second % 3], faces.lengthAt(second),
                                  faces.lengthAt(strip.start), areaOf(second));
  layout.start = corners[strip.start % 3];
  bool is_counterclockwise = true;
  for (const Strip::Door& passed : strip.doors) {
    const int leave = passed.leave, enter = passed.enter;
    OpenDoor door;
    // Seen from the corner opposite the door, the next corner of a counterclockwise face is on the right.
    door.right_before = is_counterclockwise ? nextSide(leave) : previousSide(leave);
    door.left_before = is_counterclockwise ? previousSide(leave) : nextSide(leave);
    door.right = corners[door.right_before % 3];
    door.left = corners[door.left_before % 3];
    door.left_after = passed.after(door.left_before);
    door.right_after = passed.after(door.right_before);
    is_counterclockwise = door.left_after == nextSide(enter);
    corners[door.left_after % 3] = door.left;
    corners[door.right_after % 3] = door.right;
    // The face beyond the door is to the left of the line from its left to its right end.
    corners[enter % 3] = apexLeftOf(door.left, door.right, faces.lengthAt(door.right_after),
                                    faces.lengthAt(door.left_after), areaOf(enter));
    layout.doors.push_back(door);
  }
  layout.end = corners[strip.end % 3];
  return layout;
}

/// A corner that the shortest path touches.
struct Touch {
  std::size_t door;  ///< one of the doors that end there
  bool is_left;
};

/// The funnel at the last turn: what is visible from there through the doors so far.
class Funnel {
 public:
  /// @param door the first after the apex
  Funnel(const Layout& layout, const Vector2d& apex, std::size_t door)
      : layout_(layout), apex_(apex), left_(door), right_(door) {}

  /// Narrows the funnel by a door, or by the end of the strip. @returns the next turn, if the door is not visible
  std::optional<Touch> pass(std::size_t door) {
    const Vector2d right = endOf(door, false) - apex_, left = endOf(door, true) - apex_;
    if (cross(endOf(right_, false) - apex_, right) >= 0) {
      if (cross(endOf(left_, true) - apex_, right) > 0) return Touch{left_, true};
      right_ = door;
    }
    if (cross(endOf(left_, true) - apex_, left) <= 0) {
      if (cross(endOf(right_, false) - apex_, left) < 0) return Touch{right_, false};
      left_ = door;
    }
    return {};
  }

 private:
  Vector2d endOf(std::size_t door, bool is_left) const { return layout_.endOf(door, is_left); }

  const Layout& layout_;
  const Vector2d apex_;
  std::size_t left_, right_;  ///< doors whose ends bound the funnel
};

/// The corners at which the shortest path through the doors turns, in order.
std::vector<Touch> turnsOf(const Layout& layout) {
  std::vector<Touch> turns;
  const std::size_t count = layout.doors.size();
  Vector2d apex = layout.start;
  for (std::size_t first = 0; first < count;) {
    Funnel funnel(layout, apex, first);
    std::optional<Touch> turn;
    for (std::size_t door = first + 1; door <= count && !turn; ++door) turn = funnel.pass(door);
    if (!turn) break;
    turns.push_back(*turn);
    apex = layout.endOf(turn->door, turn->is_left);
    // Doors that end at the turn are passed.
    first = turn->door;
    while (first < count && layout.endOf(first, turn->is_left) == apex) ++first;
  }
  return turns;
}

/// The consecutive doors that end at the corner of a turn.
struct Run {
  std::size_t first, last;
};

Run runAround(const Layout& layout, const Touch& touch) {
  const auto isOneCorner = [&](std::size_t d) {  // whether this door and the next end at one corner
    const OpenDoor &door = layout.doors[d], &next = layout.doors[d + 1];
    return touch.is_left ? door.left_after == next.left_before : door.right_after == next.right_before;
  };
  Run run{touch.door, touch.door};
  while (run.first > 0 && isOneCorner(run.first - 1)) --run.first;
  while (run.last + 1 < layout.doors.size() && isOneCorner(run.last)) ++run.last;
  return run;
}

/// The segment through the doors [begin, end) of a layout.
Segment segmentThrough(const MarchFaces& faces, const Strip& whole, const Layout& layout, int start, int last,
                       std::size_t begin, std::size_t end, const Vector2d& from, const Vector2d& to) {
  Segment segment;
  segment.strip.start = start;
  segment.strip.end = last;
  segment.strip.doors.assign(whole.doors.begin() + static_cast<std::ptrdiff_t>(begin),
                             whole.doors.begin() + static_cast<std::ptrdiff_t>(end));
  if (segment.strip.isEdge()) {
    // Along an edge, whose angle with itself is 0.
    const int other = thirdSlot(start, last);
    segment.length = faces.lengthAt(other);
    const double at_start = cornerAngle(faces, start), at_end = cornerAngle(faces, last);
    segment.at_start = {other == nextSide(start) ? 0 : at_start, other == nextSide(start) ? at_start : 0};
    segment.at_end = {other == nextSide(last) ? 0 : at_end, other == nextSide(last) ? at_end : 0};
    return segment;
  }
  const Vector2d way = to - from;
  segment.length = way.norm();
  for (std::size_t d = begin; d < end; ++d) {
    const OpenDoor& door = layout.doors[d];
    const Vector2d across = door.right - door.left;
    const double slope = cross(way, across);
    double share = slope != 0 ? cross(door.left - from, way) / slope : 0.5;
    share = std::clamp(std::isfinite(share) ? share : 0.5, 0.0, 1.0);
    const bool left_is_smaller = faces.vertexAt(door.left_before) < faces.vertexAt(door.right_before);
    segment.crossings.push_back(left_is_smaller ? share : 1 - share);
  }
  const auto anglesAt = [&](int slot, const OpenDoor& door, bool is_before, const Vector2d& corner,
                            const Vector2d& direction) {
    // The side opposite the next corner leads to the previous one.
    const int left = is_before ? door.left_before : door.left_after;
    const double to_left = angleBetween(door.left - corner, direction);
    const double to_right = angleBetween(door.right - corner, direction);
    return left == previousSide(slot) ? std::array{to_left, to_right} : std::array{to_right, to_left};
  };
  segment.at_start = anglesAt(start, layout.doors[begin], true, from, way);
  segment.at_end = anglesAt(last, layout.doors[end - 1], false, to, -way);
  return segment;
}

}  // namespace

bool hasClearEdges(const MarchFaces& faces, int face) {
  const auto& [a, b, c] = faces.faces[face].corners;  // ascending
  if (a == c) return false;
  for (int side = 3 * face; side < 3 * face + 3; ++side)
    if (faces.isLoop(side) && faces.loop_end[side] < 0) return false;
  return true;
}

double cornerAngle(const MarchFaces& faces, int slot) {
  const double a = faces.lengthAt(slot), b = faces.lengthAt(nextSide(slot)), c = faces.lengthAt(previousSide(slot));
  return std::atan2(faces.faces[slot / 3].doubleArea(), (b * b + (c - a) * (c + a)) / 2);
}

int cornerBeyond(const MarchFaces& faces, int corner, int leave, int enter) {
  const int next = nextSide(enter);
  return faces.vertexAt(next) == faces.vertexAt(corner) && faces.endAt(enter, next) == faces.endAt(leave, corner)
             ? next
             : previousSide(enter);
}

Strip::Door doorBetween(const MarchFaces& faces, int leave, int enter) {
  return {leave, enter, cornerBeyond(faces, nextSide(leave), leave, enter)};
}

void trim(Strip& strip) {
  while (!strip.doors.empty() && strip.end != strip.doors.back().enter) {
    strip.end = strip.doors.back().before(strip.end);
    strip.doors.pop_back();
  }
  auto first = strip.doors.begin();
  for (; first != strip.doors.end() && strip.start != first->leave; ++first) strip.start = first->after(strip.start);
  strip.doors.erase(strip.doors.begin(), first);
}

std::vector<Segment> straighten(const MarchFaces& faces, const Strip& strip) {
  const Layout layout = layOut(faces, strip);
  std::vector<Segment> segments;
  const auto slotBefore = [](const OpenDoor& door, bool is_left) {
    return is_left ? door.left_before : door.right_before;
  };
  int start = strip.start;
  bool was_left = false;
  Vector2d from = layout.start;
  std::size_t begin = 0;
  for (const Touch& touch : turnsOf(layout)) {
    const auto [first, last] = runAround(layout, touch);
    const OpenDoor &before = layout.doors[first], &after = layout.doors[last];
    const Vector2d to = touch.is_left ? before.left : before.right;
    if (first < begin) {  // along a door from one end to the other
      const OpenDoor& door = layout.doors[begin - 1];
      segments.push_back(segmentThrough(faces, strip, layout, slotBefore(door, was_left),
                                        slotBefore(door, touch.is_left), begin, begin, from, to));
    } else {
      segments.push_back(
          segmentThrough(faces, strip, layout, start, slotBefore(before, touch.is_left), begin, first, from, to));
    }
    start = touch.is_left ? after.left_after : after.right_after;
    was_left = touch.is_left;
    from = to;
    begin = last + 1;
  }
  segments.push_back(
      segmentThrough(faces, strip, layout, start, strip.end, begin, layout.doors.size(), from, layout.end));
  return segments;
}

}  // namespace tufted
