// PathSolver: first paths, straightened (docs/algorithm.md, section 18, paths).
#include "tufted/path.h"

#include <algorithm>
#include <cmath>
#include <list>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/first_path.h"
#include "algorithms/march.h"
#include "algorithms/march_faces.h"
#include "algorithms/strip.h"
#include "algorithms/turn.h"
#include "base/infinity.h"
#include "operators/check_cover.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* path_constructor = "PathSolver";
constexpr const char* path_query = "PathSolver::query";
constexpr const char* through_name = "PathSolver::through";
/// A path is led around a point only if that makes it shorter by this part, which is above rounding; it might alternate
/// forever otherwise.
constexpr double least_gain = 1e-13;
constexpr int shortenings_between_reports = 64;

using SegmentList = std::list<Segment>;

/// Step 3: leads a path around the other side of points while that makes it shorter.
/// @param keeps_class see shortcutAt()
/// @returns how often
int shorten(const MarchFaces& faces, SegmentList& path, bool keeps_class, const Workers& workers) {
  int count = 0;
  auto after = path.begin();
  if (after != path.end()) ++after;
  while (after != path.end()) {
    const auto before = std::prev(after);
    std::optional<std::vector<Segment>> pieces = shortcutAt(faces, *before, *after, keeps_class);
    const double length = before->length + after->length;
    if (!pieces || !(lengthOf(*pieces) < (1 - least_gain) * length)) {
      ++after;
      continue;
    }
    if (++count % shortenings_between_reports == 0) workers.report("straighten", 0);
    const auto end = path.erase(before, std::next(after));
    const auto first =
        path.insert(end, std::make_move_iterator(pieces->begin()), std::make_move_iterator(pieces->end()));
    // The angles at both ends of the new pieces have changed and are tested again.
    after = first == path.begin() && first != path.end() ? std::next(first) : first;
  }
  return count;
}

/// Shortens a closed path, whose last piece leads to its first, by shorten(). The path may start at another point
/// afterwards.
int shortenLoop(const MarchFaces& faces, SegmentList& path, const Workers& workers) {
  int count = shorten(faces, path, true, workers);
  while (path.size() > 1) {
    path.splice(path.end(), path, path.begin());  // now the point where the path started lies within it
    const int more = shorten(faces, path, true, workers);
    if (more == 0) break;
    count += more;
  }
  return count;
}

}  // namespace

struct PathSolver::State {
  MarchFaces faces;
  Points positions;
  std::vector<int> representative;
  int threads = 0;

  int checked(const char* function, const char* name, int point) const;
  std::vector<Strip> firstPath(const char* function, int from, int to, const Workers& workers) const;
  Points pointsOf(const SegmentList& path, int from) const;
  SegmentList piecesOf(const std::vector<Strip>& strips) const;
  SurfacePath resultOf(const SegmentList& path, int from, int shortenings) const;
  SurfacePath straightened(int from, const std::vector<Strip>& strips, const Workers& workers) const;
};

PathSolver::PathSolver(const Laplacian& laplacian, const PathOptions& options) {
  checkSizes(path_constructor, laplacian);
  checkCover(path_constructor, laplacian);
  const auto n = std::ssize(laplacian.status);
  if (laplacian.positions.rows() != n)
    throw InvalidInput(std::string(path_constructor) + ": positions has " + std::to_string(laplacian.positions.rows()) +
                       " rows, must have " + std::to_string(n));
  const Workers workers(options.threads, options.progress);
  auto state = std::make_unique<State>();
  state->faces = marchFaces(laplacian, 0, workers);
  setLoopEnds(laplacian.cover(), state->faces);
  state->positions = laplacian.positions;
  state->representative = laplacian.representative;
  state->threads = options.threads;
  state_ = std::move(state);
}

int PathSolver::State::checked(const char* function, const char* name, int point) const {
  if (point < 0 || point >= std::ssize(representative)) {
    throw InvalidInput(std::string(function) + ": " + name + " = " + std::to_string(point) + ", must lie in [0, " +
                       std::to_string(representative.size()) + ")");
  }
  return representative[point];
}

/// Step 1: a path from `from` down the marched distance or, if rounding prevents that, along edges.
std::vector<Strip> PathSolver::State::firstPath(const char* function, int from, int to, const Workers& workers) const {
  const std::vector<double> distance = marchUntil(from, faces, true, {{to, 0, 0}}, workers).distance;
  if (!(distance[from] < infinity)) {
    throw InvalidInput(std::string(function) + ": no path leads from " + std::to_string(from) + " to " +
                       std::to_string(to) + ", must lie on one component");
  }
  std::vector<Strip> strips = stripsDownhill(faces, distance, from);
  return strips.empty() ? stripsAlongEdges(faces, from, to) : strips;
}

Points PathSolver::State::pointsOf(const SegmentList& path, int from) const {
  std::vector<Eigen::RowVector3d> found = {positions.row(from)};
  for (const Segment& segment : path) {
    for (std::size_t d = 0; d < segment.crossings.size(); ++d) {
      const int side = segment.strip.doors[d].leave;
      const int one = faces.vertexAt(nextSide(side)), other = faces.vertexAt(previousSide(side));
      const int low = std::min(one, other), high = std::max(one, other);
      if (low == high) continue;  // an edge from a vertex to itself has no place in between
      const double share = segment.crossings[d];
      found.emplace_back((1 - share) * positions.row(low) + share * positions.row(high));
    }
    found.emplace_back(positions.row(faces.vertexAt(segment.strip.end)));
  }
  Points points(std::ssize(found), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) points.row(i) = found[static_cast<std::size_t>(i)];
  return points;
}

/// Step 2: the straight pieces of the shortest paths through strips.
SegmentList PathSolver::State::piecesOf(const std::vector<Strip>& strips) const {
  SegmentList path;
  for (const Strip& strip : strips) {
    std::vector<Segment> segments = straighten(faces, strip);
    path.insert(path.end(), std::make_move_iterator(segments.begin()), std::make_move_iterator(segments.end()));
  }
  return path;
}

SurfacePath PathSolver::State::resultOf(const SegmentList& path, int from, int shortenings) const {
  return {pointsOf(path, from), std::ldexp(lengthOf(path), faces.exponent), shortenings};
}

/// Steps 2 and 3: the locally shortest path near the strips of a first path.
SurfacePath PathSolver::State::straightened(int from, const std::vector<Strip>& strips, const Workers& workers) const {
  SegmentList path = piecesOf(strips);
  const int shortenings = shorten(faces, path, false, workers);
  return resultOf(path, from, shortenings);
}

SurfacePath PathSolver::query(int from, int to, const Progress& progress) const {
  const State& state = *state_;
  from = state.checked(path_query, "from", from);
  to = state.checked(path_query, "to", to);
  const Workers workers(state.threads, progress);
  if (from == to) return {state.positions.row(from), 0, 0};
  SurfacePath there = state.straightened(from, state.firstPath(path_query, from, to, workers), workers);
  // Step 4: from the other end, the first path may pass handles and hills on another side.
  SurfacePath back = state.straightened(to, state.firstPath(path_query, to, from, workers), workers);
  // Near a rim both may lead over it onto the back, where they are locally shortest, too. A path along edges does not.
  SurfacePath along = state.straightened(from, stripsAlongEdges(state.faces, from, to), workers);
  const int shortenings = there.shortenings + back.shortenings + along.shortenings;
  if (back.length < there.length) {
    there = std::move(back);
    there.points = there.points.colwise().reverse().eval();
  }
  if (along.length < (1 - least_gain) * there.length) there = std::move(along);
  there.shortenings = shortenings;
  return there;
}

SurfacePath PathSolver::through(const std::vector<int>& points, bool is_closed, const Progress& progress) const {
  const State& state = *state_;
  if (points.size() < 2)
    throw InvalidInput(std::string(through_name) + ": points has " + std::to_string(points.size()) +
                       " indices, must have at least 2");
  std::vector<int> stops;
  for (const int point : points) stops.push_back(state.checked(through_name, "points", point));
  if (is_closed) stops.push_back(stops.front());
  const Workers workers(state.threads, progress);
  SegmentList path;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    if (stops[i] == stops[i + 1]) continue;
    SegmentList leg = state.piecesOf(state.firstPath(through_name, stops[i], stops[i + 1], workers));
    shorten(state.faces, leg, false, workers);
    path.splice(path.end(), leg);
  }
  const int shortenings =
      is_closed ? shortenLoop(state.faces, path, workers) : shorten(state.faces, path, true, workers);
  const int from = path.empty() ? stops.front() : state.faces.vertexAt(path.front().strip.start);
  SurfacePath result = state.resultOf(path, from, shortenings);
  if (is_closed && !path.empty()) result.points.conservativeResize(result.points.rows() - 1, 3);
  return result;
}

}  // namespace tufted
