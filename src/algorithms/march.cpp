// Fast marching (Kimmel, Sethian 1998), the source unfolded into the plane of each triangle (docs/algorithm.md, section
// 18).
#include "algorithms/march.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algorithms/march_heap.h"
#include "algorithms/march_labels.h"
#include "algorithms/march_update.h"

namespace tufted {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Labels between two calls of `progress`.
constexpr std::int64_t between_reports = 65536;
/// A distance may be shorter than the straight line by this part because of rounding.
constexpr double straight_rounding = 1e-13;

/// The faces as triangles, not cut.
struct WholeFaces {
  const MarchFaces& faces;

  std::size_t size() const { return static_cast<std::size_t>(faces.vertices); }
  Eigen::Vector3d position(int a) const { return faces.positions[a]; }

  template <class Visit>
  void around(int a, const Visit& visit) const {
    for (int s = faces.corner_offset[a]; s < faces.corner_offset[a + 1]; ++s) {
      const MarchFace& face = faces.faces[faces.corner_slots[s] / 3];
      const int k = faces.corner_slots[s] % 3, i = (k + 1) % 3, j = (k + 2) % 3;
      visit(MarchTriangle{face.corners[i], face.corners[j], face.opposite[j], face.opposite[i], face.opposite[k],
                          face.doubleArea(), face.isBent()});
    }
  }
};

/// The four triangles into which each face is cut at the midpoints of its sides.
struct SplitFaces {
  const MarchFaces& faces;

  std::size_t size() const { return static_cast<std::size_t>(faces.vertices) + faces.edges; }
  Eigen::Vector3d position(int a) const {
    return a < faces.vertices ? faces.positions[a] : faces.middleOf(a - faces.vertices);
  }

  template <class Visit>
  void around(int a, const Visit& visit) const {
    const int n = faces.vertices;
    const bool is_middle = a >= n;
    const std::vector<int>&offset = is_middle ? faces.edge_offset : faces.corner_offset,
          &slots = is_middle ? faces.edge_slots : faces.corner_slots;
    const int first = is_middle ? offset[a - n] : offset[a], last = is_middle ? offset[a - n + 1] : offset[a + 1];
    for (int s = first; s < last; ++s) {
      const MarchFace& face = faces.faces[slots[s] / 3];
      const int k = slots[s] % 3, i = (k + 1) % 3, j = (k + 2) % 3;
      const double side_i = face.opposite[i] / 2, side_j = face.opposite[j] / 2, side_k = face.opposite[k] / 2;
      const double double_area = face.doubleArea() / 4;
      const int middle_i = n + face.edges[i], middle_j = n + face.edges[j];
      if (is_middle) {
        visit(MarchTriangle{face.corners[i], middle_j, side_k, side_i, side_j, double_area, face.isBent()});
        visit(MarchTriangle{face.corners[j], middle_i, side_k, side_j, side_i, double_area, face.isBent()});
        visit(MarchTriangle{middle_i, middle_j, side_j, side_i, side_k, double_area, face.isBent()});
      } else {
        visit(MarchTriangle{middle_j, middle_i, side_j, side_i, side_k, double_area, face.isBent()});
      }
    }
  }
};

/// One march. Equally near labels are frozen together, and new distances are set only when all are known, so that the
/// order of vertices and faces does not matter.
template <class Faces, class Labels>
class March {
 public:
  March(const Faces& faces, Labels labels, const SourcePositions& sources, double maximum,
        const std::vector<double>& known, const Workers& workers)
      : faces_(faces),
        labels_(std::move(labels)),
        heap_(labels_.size()),
        sources_(sources),
        maximum_(maximum),
        known_(known),
        workers_(workers) {}

  void start(const MarchStart& start) {
    const int label = labels_.labelAt(start.vertex, start.source, heap_);
    // In a face, a source may be nearer to the midpoint of a bent edge than to the position assumed for it, halfway
    // between the ends.
    offer(label, std::max(start.distance, straightTo(label)));
  }

  MarchResult finish() {
    while (takeNearest()) spread();
    labels_.takeNearest(result_.distance, result_.source);
    limitSlopes();
    return std::move(result_);
  }

  MarchResult finishAt(int label) {
    while (!labels_.isFrozen(label) && takeNearest()) spread();
    labels_.takeNearest(result_.distance, result_.source);
    return std::move(result_);
  }

 private:
  struct Corner {
    int label;
    MarchTriangle triangle;  ///< its vertices are labels of the same source
  };
  struct Offer {
    int label;
    double distance;
  };

  /// Freezes all labels of the least distance. False if none is left.
  bool takeNearest() {
    nearest_.clear();
    if (heap_.empty()) return false;
    const double distance = heap_.top().key;
    const bool is_late = distance < farthest_;
    farthest_ = std::max(farthest_, distance);
    while (!heap_.empty() && heap_.top().key == distance) {
      const int a = heap_.top().number;
      heap_.pop();
      labels_.freeze(a);
      if (is_late) late_.push_back(labels_.vertexOf(a));
      if (isUseful(a)) nearest_.push_back(a);
      if (++result_.visits % between_reports == 0)
        workers_.report("march",
                        std::min(1.0, static_cast<double>(result_.visits) / static_cast<double>(faces_.size())));
    }
    return true;
  }

  /// Offers distances from the labels just frozen to their neighbours.
  void spread() {
    fans_.clear();
    for (const int a : nearest_) addFan(a);
    for (const auto& [a, triangle] : fans_)
      if (labels_.goesOn(a)) alongEdges(a, triangle);
    offers_.clear();
    for (const auto& [a, triangle] : fans_) throughFace(a, triangle);
    for (const auto& [label, distance] : offers_) offer(label, distance);
  }

  void addFan(int a) {
    const int source = labels_.sourceOf(a);
    const bool goes_on = labels_.goesOn(a);
    double longest = 0;
    faces_.around(labels_.vertexOf(a), [&](MarchTriangle t) {
      longest = std::max({longest, t.ab, t.ac});
      t.b = goes_on ? labels_.labelAt(t.b, source, heap_) : labels_.knownLabelAt(t.b, source);
      t.c = goes_on ? labels_.labelAt(t.c, source, heap_) : labels_.knownLabelAt(t.c, source);
      if (t.b >= 0 && t.c >= 0) fans_.push_back({a, t});
    });
    labels_.setReach(a, longest);
  }

  /// Whether a label may lead to distances up to the maximum and below the known ones. One beyond the maximum may,
  /// through its edges.
  bool isUseful(int a) const {
    const double beyond = labels_.distance(a) - maximum_;
    const double behind =
        known_.empty() ? 0 : labels_.distance(a) - known_[static_cast<std::size_t>(labels_.vertexOf(a))];
    if (beyond <= 0 && behind <= 0) return true;
    double longest = 0;
    faces_.around(labels_.vertexOf(a), [&](const MarchTriangle& t) { longest = std::max({longest, t.ab, t.ac}); });
    return beyond <= longest && behind <= march_reach * longest;
  }

  void offer(int label, double distance) {
    if (!(distance < labels_.distance(label))) return;
    labels_.setDistance(label, distance);
    heap_.lower(label, distance);
  }

  void alongEdges(int a, const MarchTriangle& t) {
    if (!labels_.isFrozen(t.b)) offer(t.b, labels_.distance(a) + t.ab);
    if (!labels_.isFrozen(t.c)) offer(t.c, labels_.distance(a) + t.ac);
  }

  void throughFace(int a, const MarchTriangle& t) {
    if (!labels_.isFrozen(t.c)) throughEdge(a, t);
    if (!labels_.isFrozen(t.b)) throughEdge(a, {t.c, t.b, t.ac, t.ab, t.bc, t.double_area, t.is_bent});
  }

  /// Offers a distance to corner c of a triangle through its edge ab.
  void throughEdge(int a, const MarchTriangle& t) {
    const auto& [b, c, ab, ac, bc, double_area, is_bent] = t;
    const double from_a = labels_.distance(a), from_b = labels_.distance(b);
    if (!(std::abs(from_a - from_b) < ab)) return;
    bool must_see = true;
    double distance = distanceThrough(ab, ac, bc, double_area, from_a, from_b);
    if (distance == infinity && labels_.isFrozen(b) && !labels_.mustSee(c)) {
      must_see = false;
      distance = distanceThrough(ab, ac, bc, double_area, from_a, from_b, must_see);
    }
    if (!(distance < labels_.distance(c))) return;
    if (is_bent && isTooShort(c, distance)) distance = distanceInSpace(a, b, c, must_see);
    if (must_see || labels_.mayBe(c, distance)) offers_.push_back({c, distance});
  }

  /// Straight distance of a label from its source; 0 if positions are not known.
  double straightTo(int label) const {
    if (sources_.empty()) return 0;
    return (faces_.position(labels_.vertexOf(label)) - sources_[static_cast<std::size_t>(labels_.sourceOf(label))])
        .norm();
  }

  /// Whether a distance is below the straight line. Stewart's theorem excludes that for a triangle with straight sides
  /// if it does not hold at its other corners, but the unfolded source may be too near if an edge is bent in space.
  bool isTooShort(int label, double distance) const { return distance < (1 - straight_rounding) * straightTo(label); }

  /// The distance through the triangle that the corners span in space.
  double distanceInSpace(int a, int b, int c, bool must_see) const {
    const Eigen::Vector3d at_a = faces_.position(labels_.vertexOf(a));
    const Eigen::Vector3d to_b = faces_.position(labels_.vertexOf(b)) - at_a,
                          to_c = faces_.position(labels_.vertexOf(c)) - at_a;
    const double ab = to_b.norm(), from_a = labels_.distance(a), from_b = labels_.distance(b);
    if (!(std::abs(from_a - from_b) < ab)) return infinity;
    return distanceThrough(ab, to_c.norm(), (to_c - to_b).norm(), to_b.cross(to_c).norm(), from_a, from_b, must_see);
  }

  /// Lowers distances along edges until none exceeds that of a neighbour by more than the length of their edge. Only
  /// vertices that were frozen after farther ones can lower others. The heap is empty by then, and holds vertices here.
  void limitSlopes() {
    const auto lower = [&](int a, int b, double ab) {
      const double distance = result_.distance[a] + ab;
      if (!(distance < result_.distance[b] && result_.distance[b] < infinity)) return;
      result_.distance[b] = distance;
      if (!result_.source.empty()) result_.source[b] = result_.source[a];
      heap_.lower(b, distance);
    };
    const auto relax = [&](int a) {
      faces_.around(a, [&](const MarchTriangle& t) {
        lower(a, t.b, t.ab);
        lower(a, t.c, t.ac);
      });
    };
    for (const int a : late_) relax(a);
    while (!heap_.empty()) {
      const int a = heap_.top().number;
      heap_.pop();
      ++result_.lowered;
      relax(a);
    }
  }

  const Faces faces_;  // a view
  Labels labels_;
  MarchHeap heap_;
  const SourcePositions& sources_;
  const double maximum_;
  const std::vector<double>& known_;
  const Workers& workers_;
  MarchResult result_;
  double farthest_ = 0;    ///< largest distance of a frozen label
  std::vector<int> late_;  ///< vertices that were frozen after farther ones
  std::vector<int> nearest_;
  std::vector<Corner> fans_;  ///< the triangles around each of `nearest_`
  std::vector<Offer> offers_;
};

template <class Faces>
LabelsOfOneSource labelsOfOneSource(const Faces& faces, const std::vector<MarchStart>& starts) {
  return {faces.size(), starts.empty() ? -1 : starts[0].source};
}

template <class Faces>
MarchResult marchOver(const Faces& faces, const std::vector<MarchStart>& starts, double maximum, const Workers& workers,
                      const SourcePositions& sources, const std::vector<double>& known) {
  workers.report("march", 0);
  const auto finished = [&](auto march) {
    for (const MarchStart& start : starts) march.start(start);
    return march.finish();
  };
  int first = std::numeric_limits<int>::max(), last = -1;
  for (const MarchStart& start : starts) {
    first = std::min(first, start.source);
    last = std::max(last, start.source);
  }
  if (first < last)
    return finished(March(faces, LabelsOfSeveralSources(faces.size(), last + 1), sources, maximum, known, workers));
  return finished(March(faces, labelsOfOneSource(faces, starts), sources, maximum, known, workers));
}

template <class Faces>
MarchResult marchOverUntil(int vertex, const Faces& faces, const std::vector<MarchStart>& starts,
                           const Workers& workers) {
  workers.report("march", 0);
  const SourcePositions unknown;
  const std::vector<double> none;
  March march(faces, labelsOfOneSource(faces, starts), unknown, infinity, none, workers);
  for (const MarchStart& start : starts) march.start(start);
  return march.finishAt(vertex);
}

}  // namespace

MarchResult march(const MarchFaces& faces, bool split, const std::vector<MarchStart>& starts, double maximum,
                  const Workers& workers, const SourcePositions& sources, const std::vector<double>& known) {
  return split ? marchOver(SplitFaces{faces}, starts, maximum, workers, sources, known)
               : marchOver(WholeFaces{faces}, starts, maximum, workers, sources, known);
}

MarchResult marchUntil(int vertex, const MarchFaces& faces, bool split, const std::vector<MarchStart>& starts,
                       const Workers& workers) {
  return split ? marchOverUntil(vertex, SplitFaces{faces}, starts, workers)
               : marchOverUntil(vertex, WholeFaces{faces}, starts, workers);
}

}  // namespace tufted
