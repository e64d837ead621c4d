#include "algorithms/first_path.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "algorithms/apex.h"
#include "algorithms/march_heap.h"
#include "base/infinity.h"

namespace tufted {
namespace {

/// A step that meets half a side within this share of one of its ends leads to that end: a target on the side is
/// unfolded onto it only up to rounding.
constexpr double at_an_end = 1e-6;

using Eigen::Vector2d;

/// A straight step through one face from a corner or side to another; `start` and `end` are their slots.
struct Step {
  int to;  ///< number of the vertex, or V + number of the edge
  int start, end;
  double fraction;  ///< where the edge is crossed: 0 at the corner after slot `end`, 1 at the one before it
  double left;      ///< distance from there to the target
};

/// A face in the plane: the side of a slot from (0, 0) to (length, 0), and the slot's own corner above it.
struct PlaneFace {
  Vector2d after, before, own;

  PlaneFace(const MarchFaces& faces, int slot)
      : after(0, 0),
        before(faces.lengthAt(slot), 0),
        own(apexLeftOf(after, before, faces.lengthAt(previousSide(slot)), faces.lengthAt(nextSide(slot)),
                       faces.faces[slot / 3].doubleArea())) {}
};

/// The best step from a point to the sides of its faces: the target is unfolded beyond each half of a side by the
/// distances at its ends and midpoint.
class BestStep {
 public:
  BestStep(const MarchFaces& faces, const std::vector<double>& distance) : faces_(faces), distance_(distance) {}

  /// Considers the steps to one side.
  /// @param start slot of the corner or side that the point lies on
  /// @param at position of the point in the plane of the face
  /// @param after,before positions of the ends of the side
  void offer(int start, const Vector2d& at, int side, const Vector2d& after, const Vector2d& before) {
    const int edge = faces_.edgeAt(side), middle = faces_.vertices + edge;
    const Vector2d half = (after + before) / 2;
    offerHalf({after, half, distance_[faces_.vertexAt(nextSide(side))], distance_[middle], 0, 0.5}, start, at, side);
    offerHalf({half, before, distance_[middle], distance_[faces_.vertexAt(previousSide(side))], 0.5, 1}, start, at,
              side);
  }

  /// The best step; its `to` is -1 if there is none.
  const Step& step() const { return best_; }

 private:
  struct Half {
    Vector2d from, to;
    double at_from, at_to;  ///< distances from the target
    double first, last;     ///< fractions of the side
  };

  void offerHalf(const Half& half, int start, const Vector2d& at, int side) {
    if (!(half.at_from < infinity && half.at_to < infinity)) return;
    const Vector2d along = half.to - half.from;
    const double length = along.norm();
    double share = half.at_to < half.at_from ? 1 : 0;
    double left = std::min(half.at_from, half.at_to);
    if (length > 0) {
      const Vector2d unit = along / length, across(-unit.y(), unit.x());
      const double x = (length + (half.at_from - half.at_to) * ((half.at_from + half.at_to) / length)) / 2;
      const double y = std::sqrt(std::max(0.0, (half.at_from - x) * (half.at_from + x)));
      const Vector2d point = at - half.from;
      const double height = std::abs(across.dot(point)), foot = unit.dot(point);
      const double crossing = height + y > 0 ? foot + (x - foot) * (height / (height + y)) : foot;
      share = std::clamp(crossing / length, 0.0, 1.0);
      if (share < at_an_end || share > 1 - at_an_end) share = std::round(share);
      left = share <= 0 ? half.at_from : share >= 1 ? half.at_to : std::hypot(crossing - x, y);
    }
    const double fraction = half.first + share * (half.last - half.first);
    const double way = left + (at - (half.from + share * along)).norm();
    const int edge = faces_.edgeAt(side);
    const bool is_rim = faces_.edge_offset[edge + 1] - faces_.edge_offset[edge] == 1;
    if (!(way < least_) || (is_rim && fraction > 0 && fraction < 1)) return;
    least_ = way;
    if (fraction <= 0)
      best_ = {faces_.vertexAt(nextSide(side)), start, nextSide(side), 0, left};
    else if (fraction >= 1)
      best_ = {faces_.vertexAt(previousSide(side)), start, previousSide(side), 0, left};
    else
      best_ = {faces_.vertices + edge, start, side, fraction, left};
  }

  const MarchFaces& faces_;
  const std::vector<double>& distance_;
  Step best_{-1, -1, -1, 0, 0};
  double least_ = infinity;
};

/// The best step from a vertex.
Step stepFrom(const MarchFaces& faces, const std::vector<double>& distance, int vertex) {
  BestStep best(faces, distance);
  for (int i = faces.corner_offset[vertex]; i < faces.corner_offset[vertex + 1]; ++i) {
    const int slot = faces.corner_slots[i];
    if (!hasClearEdges(faces, slot / 3)) continue;
    const PlaneFace face(faces, slot);
    best.offer(slot, face.own, slot, face.after, face.before);
  }
  return best.step();
}

/// The best step from where the last one has met an edge.
Step stepOn(const MarchFaces& faces, const std::vector<double>& distance, const Step& step) {
  const int edge = step.to - faces.vertices;
  BestStep best(faces, distance);
  for (int i = faces.edge_offset[edge]; i < faces.edge_offset[edge + 1]; ++i) {
    const int slot = faces.edge_slots[i];
    if (slot == step.end || !hasClearEdges(faces, slot / 3)) continue;
    const PlaneFace face(faces, slot);
    const bool is_turned = cornerBeyond(faces, nextSide(step.end), step.end, slot) != nextSide(slot);
    const double fraction = is_turned ? 1 - step.fraction : step.fraction;
    const Vector2d at = fraction * face.before;
    best.offer(slot, at, nextSide(slot), face.before, face.own);
    best.offer(slot, at, previousSide(slot), face.own, face.after);
  }
  return best.step();
}

/// Extends a strip that ends at a side by one step.
/// @param strip `end` is the slot of that side
void goOn(const MarchFaces& faces, const Step& step, Strip& strip) {
  const int leave = strip.end, enter = step.start;
  if (step.to < faces.vertices && step.end != enter) {  // along the side to one of its ends
    strip.end = cornerBeyond(faces, step.end, enter, leave);
  } else {
    strip.doors.push_back(doorBetween(faces, leave, enter));
    strip.end = step.end;
  }
}

}  // namespace

std::vector<Strip> stripsDownhill(const MarchFaces& faces, const std::vector<double>& distance, int from) {
  std::vector<Strip> strips;
  Strip strip;
  Step step{from, -1, -1, 0, distance[from]};
  std::size_t left =
      3 * faces.faces.size();  // a path that crosses more sides than there are runs in circles by rounding
  while (step.to >= faces.vertices || distance[step.to] > 0) {
    const bool is_at_vertex = step.to < faces.vertices;
    const Step next = is_at_vertex ? stepFrom(faces, distance, step.to) : stepOn(faces, distance, step);
    if (next.to < 0 || !(next.left < step.left) || left-- == 0) return {};
    if (is_at_vertex)
      strip = {next.start, next.end, {}};
    else
      goOn(faces, next, strip);
    if (next.to < faces.vertices) {
      trim(strip);
      strips.push_back(strip);
    }
    step = next;
  }
  return strips;
}

std::vector<Strip> stripsAlongEdges(const MarchFaces& faces, int from, int to) {
  std::vector<double> distance(static_cast<std::size_t>(faces.vertices), infinity);
  std::vector<int> before(distance.size(), -1);
  std::vector<Strip> edge_to(distance.size());
  MarchHeap heap(distance.size());
  distance[from] = 0;
  heap.lower(from, 0);
  while (!heap.empty() && heap.top().number != to) {
    const int at = heap.top().number;
    heap.pop();
    for (int i = faces.corner_offset[at]; i < faces.corner_offset[at + 1]; ++i) {
      const int slot = faces.corner_slots[i];
      for (const int end : {nextSide(slot), previousSide(slot)}) {
        const int vertex = faces.vertexAt(end);
        const double way = distance[at] + faces.lengthAt(thirdSlot(slot, end));
        if (!(way < distance[vertex])) continue;
        distance[vertex] = way;
        before[vertex] = at;
        edge_to[vertex] = {slot, end, {}};
        heap.lower(vertex, way);
      }
    }
  }
  std::vector<Strip> strips;
  for (int at = to; before[at] >= 0; at = before[at]) strips.push_back(edge_to[at]);
  std::reverse(strips.begin(), strips.end());
  return strips;
}

}  // namespace tufted
