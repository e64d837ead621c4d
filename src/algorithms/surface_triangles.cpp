// Triangles of a cloud from its cover (Sharp and Crane 2020, Section 5.7; docs/algorithm.md, section 23).
#include "tufted/surface_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "algorithms/check_positions.h"
#include "algorithms/growing_surface.h"
#include "algorithms/orient_triangles.h"
#include "algorithms/triangle_candidates.h"
#include "base/parallel.h"
#include "base/sort_by_number.h"
#include "base/stage_clock.h"
#include "operators/check_cover.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* surface_triangles_name = "surfaceTriangles";
/// A triangle of at least two stars has at least this many faces in the cover: front and back for each star.
constexpr int least_faces = 4;
/// Maximum number of triangles in no star that close holes at a point; more holes there stay open.
constexpr int most_closing = 4;
/// Triangles between two calls of `progress`.
constexpr std::int64_t candidates_between_reports = 65536;

using Corners = std::array<int, 3>;

/// Maximum number of triangles at each point: all candidates, and `most_closing`.
std::vector<int> roomFor(const std::vector<TriangleCandidate>& candidates, Eigen::Index points) {
  std::vector<int> most(static_cast<std::size_t>(points), most_closing);
  for (const TriangleCandidate& candidate : candidates)
    for (const int corner : candidate.corners) ++most[corner];
  return most;
}

/// Adds triangles by falling certainty: first those of three and two stars, then those of one star if they close a gap
/// between two or three open edges.
void takeCandidates(std::vector<TriangleCandidate> candidates, const Workers& workers, GrowingSurface& fans) {
  std::sort(candidates.begin(), candidates.end(), [](const TriangleCandidate& a, const TriangleCandidate& b) {
    return std::tie(b.faces, a.radius, a.corners) < std::tie(a.faces, b.radius, b.corners);
  });
  const auto sure = std::partition_point(candidates.begin(), candidates.end(),
                                         [](const TriangleCandidate& c) { return c.faces >= least_faces; });
  for (auto candidate = candidates.begin(); candidate != sure; ++candidate) {
    const std::int64_t done = candidate - candidates.begin();
    if (done % candidates_between_reports == 0)
      workers.report("triangles", static_cast<double>(done) / static_cast<double>(candidates.size()));
    fans.add(candidate->corners);
  }
  const auto closes = [&](const Corners& corners) {
    int open = 0;
    for (int k = 0; k < 3; ++k) {
      const int faces = fans.facesAt(corners[k], corners[(k + 1) % 3]);
      if (faces > 1) return false;
      open += faces;
    }
    return open > 1;
  };
  for (bool added = true; added;) {
    added = false;
    for (auto candidate = sure; candidate != candidates.end(); ++candidate)
      added |= closes(candidate->corners) && fans.add(candidate->corners);
  }
}

/// Closes holes of three and four edges.
class HoleFiller {
 public:
  HoleFiller(const std::vector<TriangleCandidate>& candidates, const Points& positions, GrowingSurface& fans)
      : candidates_(candidates), positions_(positions), fans_(fans) {}

  /// @returns number of triangles added
  std::int64_t fill() {
    const std::size_t before = fans_.triangles().size();
    std::vector<int> rim;  // points with open edges
    std::vector<int> open;
    for (int p = 0; p < static_cast<int>(positions_.rows()); ++p) {
      fans_.openNeighbors(p, open);
      if (open.size() > 1) rim.push_back(p);
    }
    for (const int p : rim) fillAt(p);
    return std::ssize(fans_.triangles()) - static_cast<std::int64_t>(before);
  }

 private:
  /// Closes cycles of open edges through p: p, a, b or p, a, c, b.
  void fillAt(int p) {
    fans_.openNeighbors(p, open_);
    const std::vector<int> around = open_;
    for (const int a : around) {
      for (const int b : around) {
        if (a >= b || !isOpen(p, a) || !isOpen(p, b)) continue;
        if (isOpen(a, b)) {
          fans_.add({p, a, b});
          continue;
        }
        fans_.openNeighbors(a, open_);
        const std::vector<int> beyond = open_;
        for (const int c : beyond)
          if (c != p && c != b && isOpen(b, c) && fillQuadrilateral({p, a, c, b})) break;
      }
    }
  }

  bool isOpen(int a, int b) const { return fans_.facesAt(a, b) == 1; }

  /// Order of pairs of triangles, the most certain first: by most faces in the cover, then by the greater circumradius.
  std::pair<int, double> sureness(const Corners& first, const Corners& second) const {
    return {-facesOf(first) - facesOf(second), std::max(radiusOf(first), radiusOf(second))};
  }

  bool fillQuadrilateral(const std::array<int, 4>& q) {
    std::array<std::pair<Corners, Corners>, 2> ways = {
        {{{q[0], q[1], q[2]}, {q[0], q[2], q[3]}}, {{q[0], q[1], q[3]}, {q[1], q[2], q[3]}}}};
    if (sureness(ways[1].first, ways[1].second) < sureness(ways[0].first, ways[0].second)) std::swap(ways[0], ways[1]);
    for (const auto& [first, second] : ways) {
      if (!fans_.add(first)) continue;
      if (fans_.add(second)) return true;
      fans_.removeLast();
    }
    return false;
  }

  int facesOf(Corners corners) const {
    std::sort(corners.begin(), corners.end());
    const auto found =
        std::lower_bound(candidates_.begin(), candidates_.end(), corners,
                         [](const TriangleCandidate& candidate, const Corners& c) { return candidate.corners < c; });
    return found != candidates_.end() && found->corners == corners ? found->faces : 0;
  }
  double radiusOf(const Corners& c) const {
    return circumradius(positions_.row(c[0]), positions_.row(c[1]), positions_.row(c[2]));
  }

  const std::vector<TriangleCandidate>& candidates_;
  const Points& positions_;
  GrowingSurface& fans_;
  std::vector<int> open_;
};

/// Triangles that start at their smallest corner, sorted.
Triangles sorted(std::vector<Corners> triangles, std::size_t points) {
  for (Corners& corners : triangles)
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  sortByNumber(
      triangles, points, [](const Corners& corners) { return corners[0]; }, std::less<>());
  Triangles result(std::ssize(triangles), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) result(static_cast<Eigen::Index>(f), k) = triangles[f][k];
  return result;
}

}  // namespace

Triangles surfaceTriangles(const Laplacian& laplacian, const TriangleOptions& options, TriangleReport* report) {
  checkFrames(surface_triangles_name, laplacian, laplacian.frames);
  if (laplacian.kind == Kind::mesh)
    throw InvalidInput(std::string(surface_triangles_name) +
                       ": the Laplacian is of a mesh, must be of a cloud: a mesh has " + "triangles of its own");
  if (!laplacian.hasCover())
    throw InvalidInput(std::string(surface_triangles_name) +
                       ": the Laplacian has no cover, must have one: keep_cover = true");
  checkCover(surface_triangles_name, laplacian);
  const Stopwatch watch;
  const Workers workers(1, options.progress);
  TriangleReport made;
  const std::vector<TriangleCandidate> candidates = triangleCandidates(laplacian, workers);
  GrowingSurface fans(laplacian.frames, laplacian.positions, roomFor(candidates, laplacian.positions.rows()));
  takeCandidates(candidates, workers, fans);
  made.filled = HoleFiller(candidates, laplacian.positions, fans).fill();
  for (int p = 0; p < static_cast<int>(laplacian.positions.rows()); ++p)
    made.nonmanifold_vertices += fans.fansAround(p) > 1 ? 1 : 0;
  std::vector<Corners> triangles = fans.triangles();
  workers.report("orientation", 0);
  orientTriangles(laplacian, triangles, made);
  made.triangles = std::ssize(triangles);
  made.seconds = watch.seconds();
  if (report != nullptr) *report = made;
  return sorted(std::move(triangles), laplacian.status.size());
}

}  // namespace tufted
