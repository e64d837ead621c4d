// Fast marching (Kimmel, Sethian 1998) with the source unfolded into the plane of each triangle.
#include "algorithms/march.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/march_heap.h"
#include "algorithms/march_update.h"

namespace tufted {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Vertices between two calls of `progress`.
constexpr std::int64_t between_reports = 65536;

/// The triangles of faces as they are.
struct WholeFaces {
  const MarchFaces& faces;

  std::size_t size() const { return static_cast<std::size_t>(faces.vertices); }

  template <class Visit>
  void around(int a, const Visit& visit) const {
    for (int s = faces.corner_offset[a]; s < faces.corner_offset[a + 1]; ++s) {
      const MarchFace& face = faces.faces[faces.corner_slots[s] / 3];
      const int k = faces.corner_slots[s] % 3, i = (k + 1) % 3, j = (k + 2) % 3;
      visit(MarchTriangle{face.corners[i], face.corners[j], face.opposite[j], face.opposite[i], face.opposite[k],
                          face.double_area});
    }
  }
};

/// The triangles of faces that are cut into four at the middles of their sides.
struct SplitFaces {
  const MarchFaces& faces;

  std::size_t size() const { return static_cast<std::size_t>(faces.vertices) + faces.edges; }

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
      const double double_area = face.double_area / 4;
      const int middle_i = n + face.edges[i], middle_j = n + face.edges[j];
      if (is_middle) {
        visit(MarchTriangle{face.corners[i], middle_j, side_k, side_i, side_j, double_area});
        visit(MarchTriangle{face.corners[j], middle_i, side_k, side_j, side_i, double_area});
        visit(MarchTriangle{middle_i, middle_j, side_j, side_i, side_k, double_area});
      } else {
        visit(MarchTriangle{middle_j, middle_i, side_j, side_i, side_k, double_area});
      }
    }
  }
};

/// One march. All that are equally near are taken together, and distances change only when all new ones are known, so
/// that the order of vertices and faces does not matter.
template <class Faces>
class March {
 public:
  March(const Faces& faces, double maximum, const Workers& workers)
      : faces_(faces), maximum_(maximum), workers_(workers), frozen_(faces.size(), 0), heap_(faces.size()) {
    result_.distance.assign(faces.size(), infinity);
    result_.source.assign(faces.size(), -1);
  }

  void start(const MarchStart& start) { offer(start.vertex, start.distance, start.source); }

  MarchResult finish() {
    while (takeNearest()) spread();
    limitSlopes();
    return std::move(result_);
  }

  MarchResult finishAt(int vertex) {
    while (frozen_[vertex] == 0 && takeNearest()) spread();
    return std::move(result_);
  }

 private:
  struct Corner {
    int at;
    MarchTriangle triangle;
  };

  /// Freezes all vertices that are nearest. @returns whether there are some
  bool takeNearest() {
    nearest_.clear();
    if (heap_.empty()) return false;
    const double distance = heap_.top().key;
    const bool is_late = distance < farthest_;
    farthest_ = std::max(farthest_, distance);
    while (!heap_.empty() && heap_.top().key == distance) {
      const int a = heap_.top().number;
      heap_.pop();
      frozen_[a] = 1;
      if (is_late) late_.push_back(a);
      if (isUseful(a)) nearest_.push_back(a);
      if (++result_.visits % between_reports == 0)
        workers_.report("march", static_cast<double>(result_.visits) / static_cast<double>(faces_.size()));
    }
    return true;
  }

  /// Offers distances to the neighbours of the nearest vertices.
  void spread() {
    fans_.clear();
    for (const int a : nearest_) faces_.around(a, [&](const MarchTriangle& t) { fans_.push_back({a, t}); });
    for (const auto& [a, triangle] : fans_) alongEdges(a, triangle);
    offers_.clear();
    for (const auto& [a, triangle] : fans_) throughFace(a, triangle);
    for (const MarchStart& known : offers_) offer(known.vertex, known.distance, known.source);
  }

  /// Whether distances up to the maximum can come from a vertex: through one of its edges from beyond it.
  bool isUseful(int a) const {
    const double beyond = result_.distance[a] - maximum_;
    if (beyond <= 0) return true;
    double longest = 0;
    faces_.around(a, [&](const MarchTriangle& t) { longest = std::max({longest, t.ab, t.ac}); });
    return beyond <= longest;
  }

  void offer(int c, double distance, int source) {
    if (distance < result_.distance[c]) {
      result_.distance[c] = distance;
      result_.source[c] = source;
      heap_.lower(c, distance);
    } else if (distance == result_.distance[c] && source < result_.source[c]) {
      result_.source[c] = source;
    }
  }

  void alongEdges(int a, const MarchTriangle& t) {
    if (frozen_[t.b] == 0) offer(t.b, result_.distance[a] + t.ab, result_.source[a]);
    if (frozen_[t.c] == 0) offer(t.c, result_.distance[a] + t.ac, result_.source[a]);
  }

  void throughFace(int a, const MarchTriangle& t) {
    if (frozen_[t.c] == 0) throughEdge(a, t.b, t.c, t.ab, t.ac, t.bc, t.double_area);
    if (frozen_[t.b] == 0) throughEdge(a, t.c, t.b, t.ac, t.ab, t.bc, t.double_area);
  }

  void throughEdge(int a, int b, int c, double ab, double ac, double bc, double double_area) {
    const double from_a = result_.distance[a], from_b = result_.distance[b];
    // Waves from two sources have no common source to unfold.
    if (!(std::abs(from_a - from_b) < ab) || result_.source[a] != result_.source[b]) return;
    const double distance = distanceThrough(ab, ac, bc, double_area, from_a, from_b);
    if (distance < result_.distance[c]) offers_.push_back({c, distance, result_.source[a]});
  }

  /// Lowers distances along edges until none exceeds that of a neighbour by more than the length of their edge. Only
  /// what was frozen after a farther neighbour can lower it.
  void limitSlopes() {
    const auto lower = [&](int a, int b, double ab) {
      const double distance = result_.distance[a] + ab;
      if (frozen_[b] != 0 && distance < result_.distance[b]) offer(b, distance, result_.source[a]);
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
  const double maximum_;
  const Workers& workers_;
  MarchResult result_;
  std::vector<std::uint8_t> frozen_;
  MarchHeap heap_;
  double farthest_ = 0;    ///< of all that are frozen
  std::vector<int> late_;  ///< those that were frozen after farther ones
  std::vector<int> nearest_;
  std::vector<Corner> fans_;  ///< the triangles around each of `nearest_`
  std::vector<MarchStart> offers_;
};

template <class Faces>
March<Faces> started(const Faces& faces, const std::vector<MarchStart>& starts, double maximum,
                     const Workers& workers) {
  workers.report("march", 0);
  March<Faces> march(faces, maximum, workers);
  for (const MarchStart& start : starts) march.start(start);
  return march;
}

}  // namespace

MarchResult march(const MarchFaces& faces, bool split, const std::vector<MarchStart>& starts, double maximum,
                  const Workers& workers) {
  return split ? started(SplitFaces{faces}, starts, maximum, workers).finish()
               : started(WholeFaces{faces}, starts, maximum, workers).finish();
}

MarchResult marchUntil(int vertex, const MarchFaces& faces, bool split, const std::vector<MarchStart>& starts,
                       const Workers& workers) {
  return split ? started(SplitFaces{faces}, starts, infinity, workers).finishAt(vertex)
               : started(WholeFaces{faces}, starts, infinity, workers).finishAt(vertex);
}

}  // namespace tufted
