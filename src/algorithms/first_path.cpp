#include "algorithms/first_path.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/march_heap.h"

namespace tufted {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// A way that meets a side so near to its end or middle, as a share of the half, leads there: a target on the side
/// itself is unfolded onto it but for rounding.
constexpr double at_an_end = 1e-6;

using Eigen::Vector2d;

/// A straight way in one face, from a corner or a side to another. Slots are those of these corners and sides.
struct Step {
  int to;  ///< number of the vertex, or V + that of the edge
  int start, end;
  double fraction;  ///< where the edge is reached, from the corner after the side's own in this face
  double left;      ///< how far the target is from there
};

/// The corner at one end of an edge, in the face of its side `enter`.
/// @param corner that end in the face of the side `leave`
int cornerBeyond(const MarchFaces& faces, int corner, int leave, int enter) {
  const int next = nextSide(enter);
  return faces.vertexAt(next) == faces.vertexAt(corner) && faces.endAt(enter, next) == faces.endAt(leave, corner)
             ? next
             : previousSide(enter);
}

/// A face in the plane, seen from one of its slots: the side from (0, 0) to (length, 0) and the corner above it.
struct Layout {
  Vector2d after, before, own;

  Layout(const MarchFaces& faces, int slot) : after(0, 0), before(faces.lengthAt(slot), 0), own(0, 0) {
    const double length = before.x(), to_after = faces.lengthAt(previousSide(slot)),
                 to_before = faces.lengthAt(nextSide(slot));
    if (length > 0)
      own = {(length + (to_after - to_before) * ((to_after + to_before) / length)) / 2,
             faces.faces[slot / 3].double_area / length};
    else
      own = {to_after, 0};
  }
};

/// The best way on from one point of a face to a side of it, by the distances at the ends and the middle of the side:
/// the target is unfolded beyond each half.
class WayThroughFace {
 public:
  /// @param at where the point lies
  WayThroughFace(const MarchFaces& faces, const std::vector<double>& distance, const Vector2d& at, Step& best,
                 double& least)
      : faces_(faces), distance_(distance), at_(at), best_(best), least_(least) {}

  /// @param start slot of the corner or side that the point lies on
  /// @param after,before where the ends of the side lie
  void offer(int start, int side, const Vector2d& after, const Vector2d& before) {
    const int edge = faces_.edgeAt(side), middle = faces_.vertices + edge;
    const Vector2d half = (after + before) / 2;
    offerHalf({after, half, distance_[faces_.vertexAt(nextSide(side))], distance_[middle], 0, 0.5}, start, side);
    offerHalf({half, before, distance_[middle], distance_[faces_.vertexAt(previousSide(side))], 0.5, 1}, start, side);
  }

 private:
  struct Half {
    Vector2d from, to;
    double at_from, at_to;  ///< distances
    double first, last;     ///< fractions of the side
  };

  void offerHalf(const Half& half, int start, int side) {
    if (!(half.at_from < infinity && half.at_to < infinity)) return;
    const Vector2d along = half.to - half.from;
    const double length = along.norm();
    double share = half.at_to < half.at_from ? 1 : 0;
    double left = std::min(half.at_from, half.at_to);
    if (length > 0) {
      const Vector2d unit = along / length, across(-unit.y(), unit.x());
      const double x = (length + (half.at_from - half.at_to) * ((half.at_from + half.at_to) / length)) / 2;
      const double y = std::sqrt(std::max(0.0, (half.at_from - x) * (half.at_from + x)));
      const Vector2d point = at_ - half.from;
      const double height = std::abs(across.dot(point)), foot = unit.dot(point);
      const double crossing = height + y > 0 ? foot + (x - foot) * (height / (height + y)) : foot;
      share = std::clamp(crossing / length, 0.0, 1.0);
      if (share < at_an_end || share > 1 - at_an_end) share = std::round(share);
      left = share <= 0 ? half.at_from : share >= 1 ? half.at_to : std::hypot(crossing - x, y);
    }
    const double fraction = half.first + share * (half.last - half.first);
    const double way = left + (at_ - (half.from + share * along)).norm();
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
  const Vector2d at_;
  Step& best_;
  double& least_;
};

/// The best step from a vertex.
Step stepFrom(const MarchFaces& faces, const std::vector<double>& distance, int vertex) {
  Step best{-1, -1, -1, 0, 0};
  double least = infinity;
  for (int i = faces.corner_offset[vertex]; i < faces.corner_offset[vertex + 1]; ++i) {
    const int slot = faces.corner_slots[i];
    if (!hasClearEdges(faces, slot / 3)) continue;
    const Layout face(faces, slot);
    WayThroughFace(faces, distance, face.own, best, least).offer(slot, slot, face.after, face.before);
  }
  return best;
}

/// The best step from where the step before has met an edge.
Step stepOn(const MarchFaces& faces, const std::vector<double>& distance, const Step& step) {
  const int edge = step.to - faces.vertices;
  Step best{-1, -1, -1, 0, 0};
  double least = infinity;
  for (int i = faces.edge_offset[edge]; i < faces.edge_offset[edge + 1]; ++i) {
    const int slot = faces.edge_slots[i];
    if (slot == step.end || !hasClearEdges(faces, slot / 3)) continue;
    const Layout face(faces, slot);
    const bool is_turned = cornerBeyond(faces, nextSide(step.end), step.end, slot) != nextSide(slot);
    const double fraction = is_turned ? 1 - step.fraction : step.fraction;
    WayThroughFace way(faces, distance, fraction * face.before, best, least);
    // The corner after that of the side `nextSide(slot)` is `previousSide(slot)`, and so on.
    way.offer(slot, nextSide(slot), face.before, face.own);
    way.offer(slot, previousSide(slot), face.own, face.after);
  }
  return best;
}

/// Makes strips of steps from vertex to vertex.
class StripMaker {
 public:
  explicit StripMaker(const MarchFaces& faces) : faces_(faces) {}

  void add(const Step& step) {
    if (!is_open_) {
      strip_ = {step.start, step.end, {}};
      is_open_ = true;
    } else {
      pass(step);
    }
    if (step.to >= faces_.vertices) return;  // goes on from the middle of a side
    trim(strip_);
    strips_.push_back(strip_);
    is_open_ = false;
  }
  std::vector<Strip> finish() { return std::move(strips_); }

 private:
  /// Goes on from the middle of a side where the strip ends.
  void pass(const Step& step) {
    const int leave = strip_.end, enter = step.start;
    if (step.to < faces_.vertices && step.end != enter) {  // along the side to one of its ends
      strip_.end = cornerBeyond(faces_, step.end, enter, leave);
    } else {
      strip_.doors.push_back({leave, enter, cornerBeyond(faces_, nextSide(leave), leave, enter)});
      strip_.end = step.end;
    }
  }

  const MarchFaces& faces_;
  std::vector<Strip> strips_;
  Strip strip_{};  ///< `end` is a corner or, between steps, the side that was reached
  bool is_open_ = false;
};

}  // namespace

std::vector<Strip> stripsDownhill(const MarchFaces& faces, const std::vector<double>& distance, int from) {
  StripMaker strips(faces);
  Step step{from, -1, -1, 0, distance[from]};
  std::size_t left = 3 * faces.faces.size();  // who crosses more sides than there are goes in circles by rounding
  while (step.to >= faces.vertices || distance[step.to] > 0) {
    const Step next = step.to < faces.vertices ? stepFrom(faces, distance, step.to) : stepOn(faces, distance, step);
    if (next.to < 0 || !(next.left < step.left) || left-- == 0) return {};
    strips.add(next);
    step = next;
  }
  return strips.finish();
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
