// The way of least angle around a point (Xin, Wang 2007), where any number of triangles may meet at an edge.
#include "algorithms/turn.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <queue>
#include <span>
#include <utility>

#include "algorithms/straight_way.h"
#include "base/infinity.h"

namespace tufted {
namespace {

/// Angles within this of pi, in radians, count as straight.
constexpr double straight_angle = 1e-9;
/// Maximum number of faces to try per triangle of a piece that is laid through others; usually two meet at an edge,
/// three next to flips.
constexpr int most_faces_by_doors = 8;

/// An end of an edge at a point. An edge from the point to itself has two.
struct EdgeEnd {
  int edge, end;
  friend bool operator==(const EdgeEnd& a, const EdgeEnd& b) { return a.edge == b.edge && a.end == b.end; }
  friend bool operator<(const EdgeEnd& a, const EdgeEnd& b) {
    return std::pair(a.edge, a.end) < std::pair(b.edge, b.end);
  }
};

EdgeEnd edgeEnd(const MarchFaces& faces, int side, int corner) {
  return {faces.edgeAt(side), faces.endAt(side, corner)};
}

/// The edges at a point and the triangles between them.
class VertexLink {
 public:
  VertexLink(const MarchFaces& faces, int vertex) : faces_(faces) {
    for (int i = faces.corner_offset[vertex]; i < faces.corner_offset[vertex + 1]; ++i) {
      const int slot = faces.corner_slots[i];
      if (!hasClearEdges(faces, slot / 3)) continue;
      for (const int side : {nextSide(slot), previousSide(slot)})
        sides_.push_back({edgeEnd(faces, side, slot), slot, side});
    }
    std::sort(sides_.begin(), sides_.end());
    for (std::size_t i = 0; i < sides_.size(); ++i)
      if (i == 0 || !(sides_[i - 1].edge == sides_[i].edge)) nodes_.push_back({sides_[i].edge, i, infinity, -1, -1});
  }

  /// Starts the search at an edge with the given angle.
  void start(const EdgeEnd& edge, double angle) {
    const int node = nodeOf(edge);
    if (node < 0 || !(angle < nodes_[node].angle)) return;
    nodes_[node].angle = angle;
    queue_.push({angle, node});
  }
  /// Finds the ways of least angle to all edges (Dijkstra).
  void search() {
    while (!queue_.empty()) {
      const auto [angle, node] = queue_.top();
      queue_.pop();
      if (angle > nodes_[node].angle) continue;
      for (const auto& [edge, slot, side] : sidesOf(node)) {
        const int other = nodeOf(edgeEnd(faces_, thirdSlot(slot, side), slot));
        const double reached = angle + cornerAngle(faces_, slot);
        if (!(reached < nodes_[other].angle)) continue;
        nodes_[other].angle = reached;
        nodes_[other].before = node;
        nodes_[other].slot = slot;
        queue_.push({reached, other});
      }
    }
  }
  double angleTo(const EdgeEnd& edge) const {
    const int node = nodeOf(edge);
    return node < 0 ? infinity : nodes_[node].angle;
  }
  struct Side {
    EdgeEnd edge;
    int slot, side;  ///< slots of the corner at the point and of the edge, in the same triangle
    bool operator<(const Side& other) const { return std::pair(edge, side) < std::pair(other.edge, other.side); }
  };
  /// The triangles at an edge.
  std::span<const Side> sidesAt(const EdgeEnd& edge) const {
    const int node = nodeOf(edge);
    return node < 0 ? std::span<const Side>() : sidesOf(node);
  }
  /// The edges on the way to an edge and, between them, the corners of triangles at the point.
  void wayTo(const EdgeEnd& edge, std::vector<EdgeEnd>& edges, std::vector<int>& slots) const {
    for (int node = nodeOf(edge); node >= 0; node = nodes_[node].before) {
      edges.push_back(nodes_[node].edge);
      if (nodes_[node].before >= 0) slots.push_back(nodes_[node].slot);
    }
    std::reverse(edges.begin(), edges.end());
    std::reverse(slots.begin(), slots.end());
  }

 private:
  struct Node {
    EdgeEnd edge;
    std::size_t first;  ///< place of its first side
    double angle;
    int before, slot;  ///< previous node on the way, and the corner between; -1: none
  };

  int nodeOf(const EdgeEnd& edge) const {
    const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), edge,
                                        [](const Node& node, const EdgeEnd& wanted) { return node.edge < wanted; });
    return found != nodes_.end() && found->edge == edge ? static_cast<int>(found - nodes_.begin()) : -1;
  }

  std::span<const Side> sidesOf(int node) const {
    const std::size_t end = node + 1 < std::ssize(nodes_) ? nodes_[node + 1].first : sides_.size();
    return std::span(sides_).subspan(nodes_[node].first, end - nodes_[node].first);
  }

  const MarchFaces& faces_;
  std::vector<Side> sides_;
  std::vector<Node> nodes_;
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> queue_;
};

/// The side of a corner that lies on an edge.
int sideAt(const MarchFaces& faces, int slot, const EdgeEnd& edge) {
  return edgeEnd(faces, nextSide(slot), slot) == edge ? nextSide(slot) : previousSide(slot);
}

/// The edge that a strip without doors runs along, at its corner `slot`.
EdgeEnd edgeOf(const MarchFaces& faces, const Strip& strip, int slot) {
  return edgeEnd(faces, thirdSlot(strip.start, strip.end), slot);
}

/// Straightens two pieces that meet in one triangle, without the triangles in which the second returns through the
/// first.
std::vector<Segment> straightenTogether(const MarchFaces& faces, const Strip& before, const Strip& after) {
  Strip strip{before.start, after.end, before.doors};
  auto rest = after.doors.begin();
  while (!strip.doors.empty() && rest != after.doors.end() && strip.doors.back().enter == rest->leave) {
    const int leave = strip.doors.back().leave, enter = rest->enter;
    strip.doors.pop_back();
    ++rest;
    if (leave == enter) continue;
    strip.doors.push_back(doorBetween(faces, leave, enter));
    break;
  }
  strip.doors.insert(strip.doors.end(), rest, after.doors.end());
  trim(strip);
  if (strip.isEdge() && strip.start == strip.end) return {};
  return straighten(faces, strip);
}

/// Inserts the triangles around the point between those of two pieces.
/// @param goal the edge at the start of the second piece where the way around the point ends
Strip join(const MarchFaces& faces, const VertexLink& link, const Strip& before, const Strip& after,
           const EdgeEnd& goal) {
  std::vector<EdgeEnd> edges;
  std::vector<int> slots;
  link.wayTo(goal, edges, slots);
  if (!before.isEdge()) slots.insert(slots.begin(), before.end);
  if (!after.isEdge()) slots.push_back(after.start);
  Strip strip{before.start, after.end, before.doors};
  // The far end of an edge lies opposite the other side at the point.
  const auto farEnd = [&](int slot, const EdgeEnd& edge) { return thirdSlot(slot, sideAt(faces, slot, edge)); };
  if (before.isEdge()) strip.start = farEnd(slots.front(), edges.front());
  if (after.isEdge()) strip.end = farEnd(slots.back(), edges.back());
  std::size_t edge = before.isEdge() ? 1 : 0;
  for (std::size_t i = 0; i + 1 < slots.size(); ++i, ++edge) {
    const int leave = sideAt(faces, slots[i], edges[edge]), enter = sideAt(faces, slots[i + 1], edges[edge]);
    const bool is_next = nextSide(leave) == slots[i];  // the point itself
    strip.doors.push_back({leave, enter, is_next ? slots[i + 1] : thirdSlot(enter, slots[i + 1])});
  }
  strip.doors.insert(strip.doors.end(), after.doors.begin(), after.doors.end());
  trim(strip);
  return strip;
}

/// Triangles that flips led over a rim overlap others. The second piece, which starts in one of them, is laid through
/// each of the others if the angle around the point is then below pi.
/// @returns the shortest result, if it is shorter than both pieces together
std::optional<std::vector<Segment>> shortcutThroughOthers(const MarchFaces& faces, const VertexLink& link,
                                                          const Segment& before, const Segment& after) {
  const Strip& first = before.strip;
  const int start = after.strip.start, target = faces.vertexAt(after.strip.end);
  const int most_faces = most_faces_by_doors * static_cast<int>(after.strip.doors.size() + 1);
  std::optional<std::vector<Segment>> best;
  double least = before.length + after.length;
  for (const int i : {0, 1}) {
    const double angle = after.at_start[i];
    for (const VertexLink::Side& at :
         link.sidesAt(edgeEnd(faces, i == 0 ? nextSide(start) : previousSide(start), start))) {
      const double rest = cornerAngle(faces, at.slot) - angle;
      const EdgeEnd beyond = edgeEnd(faces, thirdSlot(at.slot, at.side), at.slot);
      const bool is_with_first = !first.isEdge() && first.end == at.slot;
      const double around = is_with_first ? 0 : link.angleTo(beyond) + rest;
      if (at.slot == start || !(rest > 0 && around < std::numbers::pi - straight_angle)) continue;
      const double from_first = at.side == previousSide(at.slot) ? angle : rest;
      const std::optional<Strip> other = straightWay(faces, at.slot, from_first, after.length, target, most_faces);
      if (!other) continue;
      std::vector<Segment> pieces = is_with_first ? straightenTogether(faces, first, *other)
                                                  : straighten(faces, join(faces, link, first, *other, beyond));
      if (!(lengthOf(pieces) < least)) continue;
      least = lengthOf(pieces);
      best = std::move(pieces);
    }
  }
  return best;
}

}  // namespace

std::optional<std::vector<Segment>> shortcutAt(const MarchFaces& faces, const Segment& before, const Segment& after,
                                               bool keeps_class) {
  const Strip &first = before.strip, &second = after.strip;
  const int slot = first.end;
  if (first.isEdge() && second.isEdge() && edgeOf(faces, first, first.end) == edgeOf(faces, second, second.start))
    return std::vector<Segment>();
  if (!first.isEdge() && !second.isEdge() && first.end == second.start) {
    // Both pieces lie in one triangle at the point.
    if (!(std::abs(before.at_end[0] - after.at_start[0]) < std::numbers::pi - straight_angle)) return {};
    return straightenTogether(faces, first, second);
  }
  VertexLink link(faces, faces.vertexAt(slot));
  if (first.isEdge()) {
    link.start(edgeOf(faces, first, slot), 0);
  } else {
    link.start(edgeEnd(faces, nextSide(slot), slot), before.at_end[0]);
    link.start(edgeEnd(faces, previousSide(slot), slot), before.at_end[1]);
  }
  link.search();
  EdgeEnd goal{-1, 0};
  double least = infinity;
  const auto offer = [&](const EdgeEnd& edge, double angle) {
    if (const double sum = link.angleTo(edge) + angle; sum < least) {
      least = sum;
      goal = edge;
    }
  };
  if (second.isEdge()) {
    offer(edgeOf(faces, second, second.start), 0);
  } else {
    offer(edgeEnd(faces, nextSide(second.start), second.start), after.at_start[0]);
    offer(edgeEnd(faces, previousSide(second.start), second.start), after.at_start[1]);
  }
  if (least < std::numbers::pi - straight_angle) return straighten(faces, join(faces, link, first, second, goal));
  if (second.isEdge() || keeps_class) return {};
  return shortcutThroughOthers(faces, link, before, after);
}

}  // namespace tufted
