// DistanceSolver: checks arguments, calls marching or the heat method, and completes the results of both.
#include "tufted/distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "algorithms/connected.h"
#include "algorithms/greater.h"
#include "algorithms/heat_distance.h"
#include "algorithms/heat_time.h"
#include "algorithms/marching_distance.h"
#include "algorithms/place_in_cover.h"
#include "base/cover_source.h"
#include "base/infinity.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/require.h"
#include "base/stage_clock.h"
#include "operators/check_cover.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* distance_constructor = "DistanceSolver";
constexpr const char* distance_query = "DistanceSolver::query";

void checkArguments(const Laplacian& laplacian, const DistanceOptions& options) {
  checkSizes(distance_constructor, laplacian);
  const std::string name = std::string(distance_constructor) + ": ";
  requireChoice(options.method, DistanceMethod::heat, distance_constructor, "method");
  requireChoice(options.unit, TimeUnit::adapted_edge, distance_constructor, "unit");
  checkHeatTime(distance_constructor, options.time_step);
  if (!(options.maximum > 0))
    throw InvalidInput(name + "maximum = " + numberText(options.maximum) + ", must be above 0");
  checkCover(distance_constructor, laplacian);
}

}  // namespace

struct DistanceSolver::State {
  Components components;
  std::vector<int> representative;
  std::vector<PointStatus> status;
  std::shared_ptr<const CoverSource> cover;  ///< shared with the Laplacian or its builder
  double maximum = infinity;
  int threads = 0;
  std::optional<MarchingDistance> marching;
  std::optional<HeatDistance> heat;
  SolverReport report;

  bool isActive(int point) const { return components.of[point] >= 0; }
  /// Whether a source, at representatives, lies on a component.
  bool takesPart(const SurfacePoint& source) const {
    return (source.weights[0] > 0 && isActive(source.corners[0])) ||
           (source.weights[1] > 0 && isActive(source.corners[1])) ||
           (source.weights[2] > 0 && isActive(source.corners[2]));
  }
  std::vector<SurfacePoint> checked(const std::vector<SurfacePoint>& sources) const;
  NearestSources nearestByHeat(const std::vector<PlaceInCover>& places, const Progress& progress,
                               DistanceReport& made) const;
  void finish(const std::vector<SurfacePoint>& sources, NearestSources& found) const;
};

void DistanceReport::add(const DistanceReport& other) {
  split = std::max(split, other.split);
  visits += other.visits;
  lowered += other.lowered;
  rounds += other.rounds;
  iterations = std::max(iterations, other.iterations);
  residual = greater(residual, other.residual);
  backward_error = greater(backward_error, other.backward_error);
  seconds += other.seconds;
  if (other.weak_joint) weak_joint = other.weak_joint;
}

DistanceSolver::DistanceSolver(const Laplacian& laplacian, const DistanceOptions& options) {
  checkArguments(laplacian, options);
  const int split = checkedSplit(distance_constructor, options.split, laplacian);
  const Stopwatch watch;
  auto state = std::make_unique<State>();
  state->components = findComponents(laplacian);
  state->representative = laplacian.representative;
  state->status = laplacian.status;
  state->cover = laplacian.cover_source;
  state->maximum = options.maximum;
  state->threads = options.solver.threads;
  if (options.method == DistanceMethod::marching)
    state->report = state->marching.emplace(laplacian, split, options).report();
  else
    state->report = state->heat.emplace(laplacian, state->components, options).report();
  state->report.seconds = watch.seconds();
  state_ = std::move(state);
}

double DistanceSolver::timeStep() const {
  return state_->heat ? state_->heat->timeStep() : 0;
}

const SolverReport& DistanceSolver::report() const {
  return state_->report;
}

/// Checks sources, and replaces their corners by the representatives.
std::vector<SurfacePoint> DistanceSolver::State::checked(const std::vector<SurfacePoint>& sources) const {
  if (sources.empty()) throw InvalidInput(std::string(distance_query) + ": sources is empty, must name at least one");
  std::vector<SurfacePoint> found = sources;
  bool has_one = false;
  for (SurfacePoint& source : found) {
    checkPlace(distance_query, source, static_cast<int>(representative.size()));
    for (int& corner : source.corners) corner = representative[corner];
    has_one |= takesPart(source);
  }
  if (!has_one) {
    int k = 0;
    while (k < 2 && !(sources[0].weights[k] > 0)) ++k;
    throw InvalidInput(std::string(distance_query) +
                       ": no source lies on a component, must be at least one active point: " +
                       whyOnNone("source", sources[0].corners[k], status[found[0].corners[k]]));
  }
  return found;
}

/// Sets distances on components without sources and beyond the maximum to infinity, and copies to coincident points.
void DistanceSolver::State::finish(const std::vector<SurfacePoint>& sources, NearestSources& found) const {
  std::vector<bool> has_source(static_cast<std::size_t>(components.count), false);
  for (const SurfacePoint& source : sources)
    for (int k = 0; k < 3; ++k)
      if (isActive(source.corners[k])) has_source[components.of[source.corners[k]]] = true;
  for (std::size_t i = 0; i < representative.size(); ++i) {
    double& distance = found.distance[static_cast<Eigen::Index>(i)];
    if (components.of[i] < 0 || !has_source[components.of[i]] || distance > maximum) distance = infinity;
    if (!found.source.empty() && distance == infinity) found.source[i] = -1;
  }
  for (std::size_t i = 0; i < representative.size(); ++i) {
    found.distance[static_cast<Eigen::Index>(i)] = found.distance[representative[i]];
    if (!found.source.empty()) found.source[i] = found.source[representative[i]];
  }
}

NearestSources DistanceSolver::State::nearestByHeat(const std::vector<PlaceInCover>& places, const Progress& progress,
                                                    DistanceReport& made) const {
  const auto n = static_cast<Eigen::Index>(representative.size());
  NearestSources found{VectorXd::Constant(n, infinity), std::vector<int>(representative.size(), -1)};
  std::vector<PlaceInCover> here;  // places of one source
  for (std::size_t first = 0; first < places.size(); first += here.size()) {
    const int s = places[first].source;
    here.clear();
    for (std::size_t i = first; i < places.size() && places[i].source == s; ++i) here.push_back(places[i]);
    const auto& corners = here[0].point.corners;
    if (std::none_of(corners.begin(), corners.end(), [this](int corner) { return isActive(corner); })) continue;
    DistanceReport one;
    const VectorXd distance = heat->query(distance_query, here, progress, one);
    made.add(one);
    for (const int i : components.points) {
      if (!(distance[i] < found.distance[i])) continue;
      found.distance[i] = distance[i];
      found.source[i] = s;
    }
  }
  return found;
}

VectorXd DistanceSolver::query(const std::vector<int>& sources, DistanceReport* report,
                               const Progress& progress) const {
  std::vector<SurfacePoint> points;
  points.reserve(sources.size());
  for (const int source : sources) points.push_back(SurfacePoint::vertex(source));
  return queryAt(points, report, progress);
}

VectorXd DistanceSolver::queryAt(const std::vector<SurfacePoint>& sources, DistanceReport* report,
                                 const Progress& progress) const {
  if (state_->marching) return nearest(sources, report, progress).distance;
  const Stopwatch watch;
  const std::vector<SurfacePoint> known = state_->checked(sources);
  DistanceReport made;
  const std::vector<PlaceInCover> places = placesInCover(distance_query, *state_->cover, known);
  NearestSources found{state_->heat->query(distance_query, places, progress, made), {}};
  state_->finish(known, found);
  made.seconds = watch.seconds();
  if (report != nullptr) *report = made;
  return std::move(found.distance);
}

NearestSources DistanceSolver::nearest(const std::vector<SurfacePoint>& sources, DistanceReport* report,
                                       const Progress& progress) const {
  const Stopwatch watch;
  const State& state = *state_;
  const std::vector<SurfacePoint> known = state.checked(sources);
  DistanceReport made;
  const std::vector<PlaceInCover> places = placesInCover(distance_query, *state.cover, known);
  NearestSources found = state.marching ? state.marching->query(known, places, state.components.of, progress, made)
                                        : state.nearestByHeat(places, progress, made);
  state.finish(known, found);
  made.seconds = watch.seconds();
  if (report != nullptr) *report = made;
  return found;
}

Eigen::MatrixXd DistanceSolver::matrix(const std::vector<SurfacePoint>& sources, bool symmetric, DistanceReport* report,
                                       const Progress& progress) const {
  const State& state = *state_;
  const std::vector<SurfacePoint> known = state.checked(sources);
  std::vector<int> rows;
  for (std::size_t s = 0; s < known.size(); ++s) {
    const std::array<int, 3>& corners = known[s].corners;
    if (symmetric && (corners[0] != corners[1] || corners[1] != corners[2]))
      throw InvalidInput("DistanceSolver::matrix: source " + std::to_string(s) +
                         " lies inside a triangle, must be a vertex if symmetric");
    rows.push_back(corners[0]);
  }
  Eigen::MatrixXd distance = Eigen::MatrixXd::Constant(std::ssize(state.representative), std::ssize(sources), infinity);
  std::vector<DistanceReport> reports(sources.size());
  Workers(state.threads, progress).forBlocks("distances", std::ssize(sources), 1, [&](auto s, auto, int worker) {
    if (!state.takesPart(known[s])) return;
    distance.col(s) = queryAt({sources[s]}, &reports[s], worker == 0 ? progress : Progress());
  });
  DistanceReport made;
  for (const DistanceReport& one : reports) made.add(one);
  if (symmetric) {
    const Eigen::MatrixXd between = distance(rows, Eigen::all);
    distance(rows, Eigen::all) = (between + between.transpose()) / 2;
    for (std::size_t i = 0; i < state.representative.size(); ++i)
      distance.row(static_cast<Eigen::Index>(i)) = distance.row(state.representative[i]);
  }
  if (report != nullptr) *report = made;
  return distance;
}

SurfacePoint SurfacePoint::inFace(const Points& points, const Triangles& triangles, int face,
                                  const std::array<double, 3>& barycentric) {
  const std::string name = "SurfacePoint::inFace: ";
  if (face < 0 || face >= triangles.rows()) {
    throw InvalidInput(name + "face = " + std::to_string(face) + ", must lie in [0, " +
                       std::to_string(triangles.rows()) + ")");
  }
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const int corner = triangles(face, k);
    if (corner < 0 || corner >= points.rows()) {
      throw InvalidInput(name + "corner " + std::to_string(corner) + ", must lie in [0, " +
                         std::to_string(points.rows()) + ")");
    }
    if (!points.row(corner).allFinite()) {
      throw InvalidInput(name + "corner " + std::to_string(corner) + " is not finite, must be");
    }
    if (!(barycentric[k] >= 0 && std::isfinite(barycentric[k]))) {
      throw InvalidInput(name + "barycentric = " + numberText(barycentric[k]) + ", must be finite and at least 0");
    }
    sum += barycentric[k];
  }
  if (!(sum > 0 && std::isfinite(sum)))
    throw InvalidInput(name + "barycentric coordinates sum to " + numberText(sum) + ", must be above 0");
  SurfacePoint result{{triangles(face, 0), triangles(face, 1), triangles(face, 2)}, {}, {}, {}};
  const Eigen::RowVector3d origin = points.row(result.corners[0]);
  Eigen::RowVector3d place = Eigen::RowVector3d::Zero();  // relative to the first corner
  for (int k = 0; k < 3; ++k) {
    result.weights[k] = barycentric[k] / sum;
    place += result.weights[k] * (points.row(result.corners[k]) - origin);
  }
  for (int k = 0; k < 3; ++k) {
    result.distances[k] = (place - (points.row(result.corners[k]) - origin)).stableNorm();
    const int next = result.corners[(k + 1) % 3], last = result.corners[(k + 2) % 3];
    result.sides[k] = (points.row(next) - points.row(last)).stableNorm();
  }
  return result;
}

}  // namespace tufted
