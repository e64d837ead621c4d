// The way around a point with the least angle (Xin, Wang 2007), where any number of triangles may meet at an edge.
#include "algorithms/turn.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

namespace tufted {
namespace {

/// Angles that miss half a circle by less are straight.
constexpr double straight = 1e-9;
/// Sides that differ by this part at most are equally long.
constexpr double even_sides = 1e-9;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Whether a triangle can be told from its mirror image, or need not be. One with the same point twice lies on both
/// sides of the rim, front and back, which are mirror images: it is as long to the left as to the right.
bool isClear(const MarchFace& face) {
  const auto& [a, b, c] = face.corners;  // ascending
  const auto isEven = [&](double x, double y) { return std::abs(x - y) <= even_sides * std::max(x, y); };
  if (a == c) return false;
  if (a == b) return isEven(face.opposite[0], face.opposite[1]);
  return b != c || isEven(face.opposite[1], face.opposite[2]);
}

/// The edges at a point and the triangles between them.
class Link {
 public:
  Link(const MarchFaces& faces, int vertex) : faces_(faces) {
    for (int i = faces.corner_offset[vertex]; i < faces.corner_offset[vertex + 1]; ++i) {
      const int slot = faces.corner_slots[i];
      if (!isClear(faces.faces[slot / 3])) continue;
      for (const int side : {nextSide(slot), previousSide(slot)}) sides_.push_back({faces.edgeAt(side), slot, side});
    }
    std::sort(sides_.begin(), sides_.end());
    for (std::size_t i = 0; i < sides_.size(); ++i)
      if (i == 0 || sides_[i - 1].edge != sides_[i].edge) nodes_.push_back({sides_[i].edge, i, infinity, -1, -1});
  }

  /// Lets ways begin at an edge.
  void start(int edge, double angle) {
    const int node = nodeOf(edge);
    if (node < 0 || !(angle < nodes_[node].angle)) return;
    nodes_[node].angle = angle;
    queue_.push({angle, node});
  }
  /// Finds the ways to all edges.
  void search() {
    while (!queue_.empty()) {
      const auto [angle, node] = queue_.top();
      queue_.pop();
      if (angle > nodes_[node].angle) continue;
      const std::size_t end = node + 1 < std::ssize(nodes_) ? nodes_[node + 1].first : sides_.size();
      for (std::size_t i = nodes_[node].first; i < end; ++i) {
        const int slot = sides_[i].slot;
        const int other = nodeOf(faces_.edgeAt(thirdSlot(slot, sides_[i].side)));
        const double reached = angle + cornerAngle(faces_, slot);
        if (!(reached < nodes_[other].angle)) continue;
        nodes_[other].angle = reached;
        nodes_[other].before = node;
        nodes_[other].slot = slot;
        queue_.push({reached, other});
      }
    }
  }
  double angleTo(int edge) const {
    const int node = nodeOf(edge);
    return node < 0 ? infinity : nodes_[node].angle;
  }
  /// The edges and, between them, the corners of the triangles on the way to an edge.
  void wayTo(int edge, std::vector<int>& edges, std::vector<int>& slots) const {
    for (int node = nodeOf(edge); node >= 0; node = nodes_[node].before) {
      edges.push_back(nodes_[node].edge);
      if (nodes_[node].before >= 0) slots.push_back(nodes_[node].slot);
    }
    std::reverse(edges.begin(), edges.end());
    std::reverse(slots.begin(), slots.end());
  }

 private:
  struct Side {
    int edge, slot, side;
    bool operator<(const Side& other) const { return std::pair(edge, side) < std::pair(other.edge, other.side); }
  };
  struct Node {
    int edge;
    std::size_t first;  ///< of its sides
    double angle;
    int before, slot;  ///< the node before, and the corner of the triangle between
  };

  int nodeOf(int edge) const {
    const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), edge,
                                        [](const Node& node, int wanted) { return node.edge < wanted; });
    return found != nodes_.end() && found->edge == edge ? static_cast<int>(found - nodes_.begin()) : -1;
  }

  const MarchFaces& faces_;
  std::vector<Side> sides_;
  std::vector<Node> nodes_;
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> queue_;
};

/// The side at a corner that is this edge.
int sideAt(const MarchFaces& faces, int slot, int edge) {
  return faces.edgeAt(nextSide(slot)) == edge ? nextSide(slot) : previousSide(slot);
}

/// The edge that a piece of a path is.
int edgeOf(const MarchFaces& faces, const Strip& strip) {
  return faces.edgeAt(thirdSlot(strip.start, strip.end));
}

/// Drops the triangles at both ends that the way only enters to come to a corner of the door.
void trim(Strip& strip) {
  while (!strip.doors.empty() && strip.end != strip.doors.back().enter) {
    strip.end = strip.doors.back().before(strip.end);
    strip.doors.pop_back();
  }
  auto first = strip.doors.begin();
  for (; first != strip.doors.end() && strip.start != first->leave; ++first) strip.start = first->after(strip.start);
  strip.doors.erase(strip.doors.begin(), first);
}

/// Puts the triangles around the point between those of the pieces.
/// @param edges,slots the way around it, see Link::wayTo()
Strip join(const MarchFaces& faces, const Strip& before, const Strip& after, const std::vector<int>& edges,
           std::vector<int> slots) {
  if (!before.isEdge()) slots.insert(slots.begin(), before.end);
  if (!after.isEdge()) slots.push_back(after.start);
  Strip strip{before.start, after.end, before.doors};
  // The other end of an edge lies opposite the other side at the point.
  const auto farEnd = [&](int slot, int edge) { return thirdSlot(slot, sideAt(faces, slot, edge)); };
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

}  // namespace

std::optional<std::vector<Segment>> shortcutAt(const MarchFaces& faces, const Segment& before, const Segment& after) {
  const Strip &first = before.strip, &second = after.strip;
  const int slot = first.end;
  if (first.isEdge() && second.isEdge() && edgeOf(faces, first) == edgeOf(faces, second)) return std::vector<Segment>();
  if (!first.isEdge() && !second.isEdge() && first.end == second.start) {
    // Both in one triangle.
    if (!(std::abs(before.at_end[0] - after.at_start[0]) < std::numbers::pi - straight)) return {};
    Strip strip{first.start, second.end, first.doors};
    strip.doors.insert(strip.doors.end(), second.doors.begin(), second.doors.end());
    return straighten(faces, strip);
  }
  Link link(faces, faces.vertexAt(slot));
  if (first.isEdge()) {
    link.start(edgeOf(faces, first), 0);
  } else {
    link.start(faces.edgeAt(nextSide(slot)), before.at_end[0]);
    link.start(faces.edgeAt(previousSide(slot)), before.at_end[1]);
  }
  link.search();
  int goal = -1;
  double least = infinity;
  const auto offer = [&](int edge, double angle) {
    if (const double sum = link.angleTo(edge) + angle; sum < least) {
      least = sum;
      goal = edge;
    }
  };
  if (second.isEdge()) {
    offer(edgeOf(faces, second), 0);
  } else {
    offer(faces.edgeAt(nextSide(second.start)), after.at_start[0]);
    offer(faces.edgeAt(previousSide(second.start)), after.at_start[1]);
  }
  if (!(least < std::numbers::pi - straight)) return {};
  std::vector<int> edges, slots;
  link.wayTo(goal, edges, slots);
  return straighten(faces, join(faces, first, second, edges, std::move(slots)));
}

}  // namespace tufted
