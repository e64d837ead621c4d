// LogMapSolver: exact paths, or vector heat (Sharp, Soliman, Crane: "The vector heat method", 2019, Section 8.2).
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/check_positions.h"
#include "algorithms/connected.h"
#include "algorithms/connection.h"
#include "algorithms/exact_log_map.h"
#include "algorithms/heat_sources.h"
#include "algorithms/heat_time.h"
#include "algorithms/memory_limit.h"
#include "algorithms/vector_heat.h"
#include "base/require.h"
#include "base/stage_clock.h"
#include "operators/check_cover.h"
#include "tufted/distance.h"
#include "tufted/errors.h"
#include "tufted/vector_heat.h"

namespace tufted {
namespace {

constexpr const char* log_map_constructor = "LogMapSolver";
constexpr const char* log_map_query = "LogMapSolver::query";

/// The field of directions away from the source starts in a ring between these distances from it, in units of
/// FieldHeat::spacingAt(): nearer points are few, and wider rings reach over features.
constexpr double ring_begin = 2, ring_end = 8;
/// The least area of a point of the ring, in units of spacingAt() squared, so that points of mass 0 have directions,
/// too.
constexpr double least_area = 1e-3;

/// The weight of a point by its distance from the source, in units of spacingAt().
double ringWeight(double distance) {
  const double place = (2 * distance - ring_begin - ring_end) / (ring_end - ring_begin);
  const double inner = std::max(0.0, 1 - place * place);
  return inner * inner;
}

/// The map by vector heat.
struct HeatLogMap {
  SparseMatrix L;
  VectorXd M;
  Points positions;
  Frames frames;
  DistanceSolver distance;
  FieldHeat heat;

  /// The offset of a point from the source, in the source's frame and units of spacingAt().
  Eigen::Vector2d inPlane(int source, int point) const;
  /// The points connected to a source within the ring's outer distance; at least its neighbours.
  std::vector<int> disc(int source) const;
  /// The fields to transport, as columns: directions away from the source, and the two axes at the source.
  /// @param first the first axis, a unit vector in the frame of the source
  HeatFields startingFields(int source, const std::vector<int>& disc, const Eigen::Vector2d& first) const;
  /// The coordinates of all points.
  /// @param first the first axis, a unit vector in the frame of the source
  Eigen::MatrixX2d query(int source, const Eigen::Vector2d& first, VectorHeatReport& report,
                         const Progress& progress) const;
};

HeatLogMap heatLogMap(const Laplacian& laplacian, const Frames& frames, const LogMapOptions& options) {
  DistanceSolver distance(laplacian, {.solver = options.solver});
  FieldHeat heat(log_map_constructor, laplacian, &frames, {.time_step = options.time_step, .solver = options.solver},
                 memoryLimit(options.solver.memory_limit));
  return {laplacian.L, laplacian.M, laplacian.positions, frames, std::move(distance), std::move(heat)};
}

Eigen::Vector2d HeatLogMap::inPlane(int source, int point) const {
  const Eigen::RowVector3d offset = (positions.row(point) - positions.row(source)) / heat.spacingAt(source);
  const Eigen::RowVector3d normal = frames.normals.row(source), x = frames.tangents.row(source);
  return {x.dot(offset), normal.cross(x).dot(offset)};
}

std::vector<int> HeatLogMap::disc(int source) const {
  std::vector<std::uint8_t> seen(heat.size(), 0);
  std::vector<int> points = {source};
  seen[source] = 1;
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (SparseMatrix::InnerIterator entry(L, points[k]); entry; ++entry) {
      const auto q = static_cast<int>(entry.row());
      if (seen[q] != 0) continue;
      const double away = (positions.row(q) - positions.row(source)).stableNorm() / heat.spacingAt(source);
      if (k > 0 && away > ring_end) continue;
      seen[q] = 1;
      points.push_back(q);
    }
  }
  return points;
}

HeatFields HeatLogMap::startingFields(int source, const std::vector<int>& disc, const Eigen::Vector2d& first) const {
  const Eigen::Index n = heat.size();
  HeatFields start{Eigen::MatrixXd::Zero(n, 1), Eigen::MatrixXd::Zero(2 * n, 3)};
  start.scalars(source, 0) = 1;
  bool has_ring = false;
  for (const int p : disc) has_ring |= ringWeight(inPlane(source, p).norm()) > 0;
  for (const int p : disc) {
    const Eigen::Vector2d place = inPlane(source, p);
    const double weight = has_ring ? ringWeight(place.norm()) : 1;
    if (!(weight > 0 && place.norm() > 0)) continue;
    const double area = std::max(M[p] / heat.spacingAt(source) / heat.spacingAt(source), least_area);
    start.vectors.col(0).segment<2>(2 * Eigen::Index{p}) =
        weight * area * (transportBetween(frames, source, p) * place.normalized());
  }
  start.vectors.col(1).segment<2>(2 * source) = first;
  start.vectors.col(2).segment<2>(2 * source) << -first[1], first[0];
  return start;
}

Eigen::MatrixX2d HeatLogMap::query(int source, const Eigen::Vector2d& first, VectorHeatReport& report,
                                   const Progress& progress) const {
  const VectorXd lengths = distance.query({source}, nullptr, progress);
  const std::vector<int> near = disc(source);
  const HeatFields found = heat.spread(log_map_query, startingFields(source, near, first), report, progress);
  Eigen::MatrixX2d coordinates(lengths.size(), 2);
  for (int i = 0; i < lengths.size(); ++i) {
    const auto field = [&](int column) { return found.vectors.col(column).segment<2>(2 * Eigen::Index{i}); };
    const Eigen::Vector2d direction(field(0).dot(field(1)), field(0).dot(field(2)));
    coordinates.row(i) = lengths[i] * direction.normalized();
  }
  for (const int p : near) {
    const Eigen::Vector2d place = inPlane(source, p);
    if (!(place.norm() > 0 && place.norm() <= ring_begin)) continue;
    const Eigen::Vector2d direction(place.dot(first), first[0] * place[1] - first[1] * place[0]);
    coordinates.row(p) = lengths[p] * direction.normalized();
  }
  return coordinates;
}

}  // namespace

struct LogMapSolver::State {
  Frames frames;
  std::vector<int> representative;
  std::vector<PointStatus> status;
  std::optional<ExactLogMap> exact;
  std::optional<HeatLogMap> heat;
  SolverReport report;
};

LogMapSolver::LogMapSolver(const Laplacian& laplacian, const LogMapOptions& options)
    : LogMapSolver(laplacian, laplacian.frames, options) {}

LogMapSolver::LogMapSolver(const Laplacian& laplacian, const Frames& frames, const LogMapOptions& options) {
  checkFrames(log_map_constructor, laplacian, frames);
  requireChoice(options.method, LogMapMethod::heat, log_map_constructor, "method");
  checkHeatTime(log_map_constructor, options.time_step);
  if (!laplacian.hasCover())
    throw InvalidInput(std::string(log_map_constructor) +
                       ": the Laplacian has no cover, must have one: keep_cover = true");
  checkCover(log_map_constructor, laplacian);
  const Stopwatch watch;
  auto state = std::make_unique<State>();
  state->frames = frames;
  state->representative = laplacian.representative;
  state->status = laplacian.status;
  if (options.method == LogMapMethod::heat) {
    state->report = state->heat.emplace(heatLogMap(laplacian, frames, options)).heat.report();
  } else {
    state->exact.emplace(laplacian, frames, options.solver.progress);
    state->report.method = "exact";
    state->report.unknowns = std::ssize(state->status);
    state->report.bytes = state->exact->bytes();
  }
  state->report.seconds = watch.seconds();
  state_ = std::move(state);
}

const SolverReport& LogMapSolver::report() const {
  return state_->report;
}

LogMap LogMapSolver::query(int source, const Eigen::RowVector3d& axis, const Progress& progress) const {
  const Stopwatch watch;
  const State& state = *state_;
  const std::string name = std::string(log_map_query) + ": ";
  const auto n = static_cast<int>(state.status.size());
  if (source < 0 || source >= n)
    throw InvalidInput(name + "source " + std::to_string(source) + ", must lie in [0, " + std::to_string(n) + ")");
  const int s = state.representative[source];
  if (state.status[s] != PointStatus::active)
    throw InvalidInput(name + whyOnNone("source", source, state.status[s]) + ", lies on no component, must be active");
  if (!axis.allFinite()) throw InvalidInput(name + "axis is not finite, must be");
  Eigen::Vector2d first = inTangentPlane(name + "axis", state.frames, s, axis);
  first = first.norm() > 0 ? Eigen::Vector2d(first.stableNormalized()) : Eigen::Vector2d::UnitX();
  const Eigen::RowVector3d normal = state.frames.normals.row(s), x = state.frames.tangents.row(s), y = normal.cross(x);
  LogMap map;
  map.first = first[0] * x + first[1] * y;
  map.second = first[0] * y - first[1] * x;
  if (state.exact) {
    const auto [distance, angle] = state.exact->query(s, progress);
    const double begin = std::atan2(first[1], first[0]);
    map.coordinates.resize(n, 2);
    for (int i = 0; i < n; ++i) {
      const bool is_reached = std::isfinite(distance[i]);
      const double length = is_reached ? distance[i] : std::numeric_limits<double>::quiet_NaN();
      map.coordinates.row(i) << length * std::cos(angle[i] - begin), length * std::sin(angle[i] - begin);
    }
  } else {
    map.coordinates = state.heat->query(s, first, map.report, progress);
  }
  map.coordinates.row(s).setZero();
  for (int i = 0; i < n; ++i) map.coordinates.row(i) = map.coordinates.row(state.representative[i]).eval();
  map.report.seconds = watch.seconds();
  return map;
}

}  // namespace tufted
