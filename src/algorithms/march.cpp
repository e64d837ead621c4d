// Fast marching (Kimmel, Sethian 1998), the source unfolded into the plane of each triangle (docs/algorithm.md, section
// 18).
#include "algorithms/march.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "algorithms/march_heap.h"
#include "algorithms/march_sources.h"
#include "algorithms/march_update.h"
#include "algorithms/march_views.h"
#include "base/infinity.h"

namespace tufted {
namespace {

constexpr std::int64_t vertices_between_reports = 65536;
/// A source goes on from a vertex only if it is farther than the nearest source by at most this many times the longest
/// edge there. Each edge more reduces the error to a fifteenth; with 4, 22 of 90,000 distances on a flat grid are off
/// by up to 5e-9.
constexpr double march_reach = 5;
/// A source ends this many edges beside the vertices where it may be the nearest. On scans, with 8, distances from
/// sources side by side are off by up to 1.2 %, with 16 by 0.5 %, and without it 100 of them take 71 times one.
constexpr int march_margin = 16;
/// Distances along one line differ by less than this part because of rounding.
constexpr double line_rounding = 1e-13;

MarchResult unreached(std::size_t vertices) {
  return {.distance = std::vector<double>(vertices, infinity), .source = std::vector<int>(vertices, -1)};
}

/// Marches of one source at a time. Equally near vertices are frozen together, and new distances are set only when all
/// are known, so that the order of vertices and faces does not matter.
template <class Faces>
class March {
 public:
  March(const Faces& faces, const SourcePositions& sources, double maximum, const Workers& workers)
      : faces_(faces),
        sources_(sources),
        maximum_(maximum),
        workers_(workers),
        distance_(faces.size(), infinity),
        frozen_(faces.size(), 0),
        heap_(faces.size()) {}

  /// Marches from starts of one source over all faces.
  MarchResult overAll(std::vector<MarchStart> starts) {
    keepBehindLines(starts);
    marchFrom(starts);
    result_.distance = std::move(distance_);
    return std::move(result_);
  }

  /// Marches from starts of one source until a vertex is frozen.
  MarchResult until(int vertex, std::span<const MarchStart> starts) {
    begin(starts);
    while (frozen_[vertex] == 0 && takeNearest()) spread();
    result_.distance = std::move(distance_);
    return std::move(result_);
  }

  /// Marches from the starts, sorted by source, and returns the least distances with their sources.
  MarchResult fromEach(std::vector<MarchStart> starts) {
    keepBehindLines(starts);
    MarchResult result = unreached(faces_.size());
    std::vector<double> bound = result.distance;
    boundAlongEdges(faces_.faces, starts, bound);
    for (double& entry : bound) entry *= 1 + line_rounding;
    const std::vector<std::span<const MarchStart>> sources = spreadSources(starts);
    parts_ = static_cast<double>(sources.size());
    marchWithin(bound);
    for (const auto& own : sources) {
      marchFrom(own);
      for (const int a : touched_) {
        takeIfNearer(a, result);
        bound[a] = std::min(bound[a], distance_[a]);
        distance_[a] = infinity;
        frozen_[a] = 0;
      }
      touched_.clear();
      ++part_;
    }
    addWorkTo(result);
    return result;
  }

  /// Marches from starts of one more source, where it may be nearer than the sources in a result, and adds it there.
  void where(std::vector<MarchStart> starts, MarchResult& result) {
    keepBehindLines(starts);
    marchWithin(result.distance);
    marchFrom(starts);
    for (std::size_t a = 0; a < distance_.size(); ++a)
      if (frozen_[a] != 0) takeIfNearer(static_cast<int>(a), result);
    addWorkTo(result);
  }

 private:
  struct Corner {
    int vertex;
    MarchTriangle triangle;
  };
  struct Offer {
    int vertex;
    double distance;
  };

  /// Raises the distances of starts to the straight lines: in a face, a source may be nearer to the midpoint of a bent
  /// edge than to the position assumed for it, halfway between the ends.
  void keepBehindLines(std::vector<MarchStart>& starts) const {
    for (MarchStart& start : starts)
      start.distance = std::max(start.distance, straightBetween(start.vertex, start.source));
  }

  void marchFrom(std::span<const MarchStart> starts) {
    begin(starts);
    while (takeNearest()) spread();
    limitSlopes();
  }

  void begin(std::span<const MarchStart> starts) {
    farthest_ = 0;
    late_.clear();
    visits_before_ = result_.visits;
    if (starts.empty()) return;
    source_ = starts[0].source;
    for (const MarchStart& start : starts) {
      if (!bound_.empty()) edges_beside_[start.vertex] = 0;
      offer(start.vertex, start.distance);
    }
  }

  /// From now on a source ends where it is not the nearest.
  void marchWithin(std::span<const double> bound) {
    bound_ = bound;
    longest_.resize(faces_.size(), 0);
    edges_beside_.resize(faces_.size(), 0);
  }

  /// Takes a distance that is less than that of a source before, of equal ones that of the first.
  void takeIfNearer(int a, MarchResult& result) const {
    if (!(std::pair(distance_[a], source_) < std::pair(result.distance[a], result.source[a]))) return;
    result.distance[a] = distance_[a];
    result.source[a] = source_;
  }

  void addWorkTo(MarchResult& result) const {
    result.visits += result_.visits;
    result.lowered += result_.lowered;
  }

  /// Freezes all vertices of the least distance. False if none is left.
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
      if (parts_ > 1) touched_.push_back(a);
      if (!bound_.empty() && distance <= bound_[a]) edges_beside_[a] = 0;
      if (distance <= maximum_ || distance - maximum_ <= longestEdgeAt(a)) nearest_.push_back(a);
      if (++result_.visits % vertices_between_reports == 0) {
        const double share = static_cast<double>(result_.visits - visits_before_) / static_cast<double>(faces_.size());
        workers_.report("march", (part_ + std::min(1.0, share)) / parts_);
      }
    }
    return true;
  }

  /// Offers distances from the vertices just frozen to their neighbours.
  void spread() {
    fans_.clear();
    for (const int a : nearest_) {
      const bool goes_on = mayBeNearest(a);
      faces_.around(a, [&](const MarchTriangle& t) {
        if (goes_on) alongEdges(a, t);
        fans_.push_back({a, t});
      });
    }
    offers_.clear();
    for (const auto& [a, triangle] : fans_) throughFace(a, triangle);
    for (const auto& [vertex, distance] : offers_) offer(vertex, distance);
  }

  /// Whether the source may be the nearest of all at a vertex, or is not far beside such vertices.
  bool mayBeNearest(int a) {
    return bound_.empty() || distance_[a] <= bound_[a] ||
           (edges_beside_[a] < march_margin && distance_[a] - bound_[a] <= march_reach * longestEdgeAt(a));
  }

  double longestEdgeAt(int a) {
    double longest = longest_.empty() ? 0 : longest_[a];
    if (longest > 0) return longest;
    faces_.around(a, [&](const MarchTriangle& t) { longest = std::max({longest, t.ab, t.ac}); });
    return longest_.empty() ? longest : longest_[a] = static_cast<float>(longest);
  }

  void offer(int vertex, double distance) {
    if (!(distance < distance_[vertex])) return;
    distance_[vertex] = distance;
    heap_.lower(vertex, distance);
  }

  void alongEdges(int a, const MarchTriangle& t) {
    alongEdge(a, t.b, t.ab);
    alongEdge(a, t.c, t.ac);
  }

  void alongEdge(int a, int b, double ab) {
    if (frozen_[b] != 0) return;
    if (!bound_.empty()) {
      const auto edges = static_cast<std::uint8_t>(edges_beside_[a] + 1);
      edges_beside_[b] = distance_[b] < infinity ? std::min(edges_beside_[b], edges) : edges;
    }
    offer(b, distance_[a] + ab);
  }

  void throughFace(int a, const MarchTriangle& t) {
    if (frozen_[t.c] == 0) throughEdge(a, t);
    if (frozen_[t.b] == 0) throughEdge(a, {t.c, t.b, t.ac, t.ab, t.bc, t.double_area, t.is_bent});
  }

  /// Offers a distance to corner c of a triangle through its edge ab.
  void throughEdge(int a, const MarchTriangle& t) {
    const auto& [b, c, ab, ac, bc, double_area, is_bent] = t;
    const double from_a = distance_[a], from_b = distance_[b];
    if (!(std::abs(from_a - from_b) < ab) || distance_[c] == infinity) return;
    bool must_see = true;
    double distance = distanceThrough(ab, ac, bc, double_area, from_a, from_b);
    if (distance == infinity && frozen_[b] != 0 && !mayBeNearest(c)) {
      must_see = false;
      distance = distanceThrough(ab, ac, bc, double_area, from_a, from_b, must_see);
    }
    if (!(distance < distance_[c])) return;
    if (is_bent && isTooShort(c, distance)) distance = distanceInSpace(a, b, c, must_see);
    if (must_see || distance > bound_[c]) offers_.push_back({c, distance});
  }

  /// 0 if positions are not known.
  double straightBetween(int vertex, int source) const {
    return sources_.empty() ? 0 : (faces_.position(vertex) - sources_[static_cast<std::size_t>(source)]).norm();
  }

  /// Whether a distance is below the straight line. Stewart's theorem excludes that for a triangle with straight sides
  /// if it does not hold at its other corners, but the unfolded source may be too near if an edge is bent in space.
  bool isTooShort(int vertex, double distance) const {
    return distance < (1 - line_rounding) * straightBetween(vertex, source_);
  }

  /// The distance through the triangle that the corners span in space.
  double distanceInSpace(int a, int b, int c, bool must_see) const {
    const Eigen::Vector3d at_a = faces_.position(a);
    const Eigen::Vector3d to_b = faces_.position(b) - at_a, to_c = faces_.position(c) - at_a;
    const double ab = to_b.norm(), from_a = distance_[a], from_b = distance_[b];
    if (!(std::abs(from_a - from_b) < ab)) return infinity;
    return distanceThrough(ab, to_c.norm(), (to_c - to_b).norm(), to_b.cross(to_c).norm(), from_a, from_b, must_see);
  }

  /// Lowers distances along edges until none exceeds that of a neighbour by more than the length of their edge. Only
  /// vertices that were frozen after farther ones can lower others.
  void limitSlopes() {
    const auto lower = [&](int a, int b, double ab) {
      const double distance = distance_[a] + ab;
      if (!(distance < distance_[b] && distance_[b] < infinity)) return;
      distance_[b] = distance;
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
  const SourcePositions& sources_;
  const double maximum_;
  const Workers& workers_;
  std::vector<double> distance_;
  std::vector<std::uint8_t> frozen_;
  MarchHeap heap_;
  MarchResult result_;
  int source_ = 0;         ///< that marches
  double farthest_ = 0;    ///< largest distance of a frozen vertex
  std::vector<int> late_;  ///< vertices that were frozen after farther ones
  std::vector<int> nearest_;
  std::vector<Corner> fans_;  ///< the triangles around each of `nearest_`
  std::vector<Offer> offers_;
  // The members below serve marches from several sources. One source alone leaves them empty.
  std::span<const double> bound_;  ///< no distance from the nearest source is greater
  std::vector<float> longest_;     ///< edge at each vertex; 0: not known yet
  /// Edges to the nearest vertex where the source may be the nearest, at most `march_margin`.
  std::vector<std::uint8_t> edges_beside_;
  std::vector<int> touched_;     ///< vertices that one of several sources has reached
  double part_ = 0, parts_ = 1;  ///< of the progress: sources done, and all
  std::int64_t visits_before_ = 0;
};

/// Calls a function with the march over the faces.
template <class Call>
auto overFaces(const MarchFaces& faces, bool split, const SourcePositions& sources, double maximum,
               const Workers& workers, const Call& call) {
  workers.report("march", 0);
  return split ? call(March(SplitFaces{faces}, sources, maximum, workers))
               : call(March(WholeFaces{faces}, sources, maximum, workers));
}

}  // namespace

MarchResult march(const MarchFaces& faces, bool split, std::vector<MarchStart> starts, double maximum,
                  const Workers& workers, const SourcePositions& sources) {
  std::stable_sort(starts.begin(), starts.end(),
                   [](const MarchStart& a, const MarchStart& b) { return a.source < b.source; });
  if (starts.empty() || starts.front().source == starts.back().source)
    return overFaces(faces, split, sources, maximum, workers, [&](auto march) { return march.overAll(starts); });
  return overFaces(faces, split, sources, maximum, workers, [&](auto march) { return march.fromEach(starts); });
}

MarchResult unreached(const MarchFaces& faces) {
  return unreached(WholeFaces{faces}.size());
}

void marchWhereNearer(const MarchFaces& faces, const std::vector<MarchStart>& starts, const Workers& workers,
                      const SourcePositions& sources, MarchResult& result) {
  overFaces(faces, false, sources, infinity, workers, [&](auto march) { march.where(starts, result); });
}

MarchResult marchUntil(int vertex, const MarchFaces& faces, bool split, const std::vector<MarchStart>& starts,
                       const Workers& workers) {
  const SourcePositions unknown;
  return overFaces(faces, split, unknown, infinity, workers, [&](auto march) { return march.until(vertex, starts); });
}

}  // namespace tufted
