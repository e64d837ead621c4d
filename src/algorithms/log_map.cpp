// The logarithmic map (Sharp, Soliman, Crane: "The vector heat method", 2019, Section 8.2).
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/check_positions.h"
#include "algorithms/connection.h"
#include "algorithms/heat_sources.h"
#include "algorithms/memory_limit.h"
#include "algorithms/vector_heat.h"
#include "base/stage_clock.h"
#include "tufted/distance.h"
#include "tufted/errors.h"
#include "tufted/vector_heat.h"

namespace tufted {
namespace {

constexpr const char* constructor = "LogMapSolver";
constexpr const char* query_name = "LogMapSolver::query";

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

}  // namespace

struct LogMapSolver::State {
  SparseMatrix L;
  VectorXd M;
  Points positions;
  Frames frames;
  DistanceSolver distance;
  FieldHeat heat;
  SolverReport report;

  /// The offset of a point from the source, in the source's frame and units of spacingAt().
  Eigen::Vector2d inPlane(int source, int point) const;
  /// The points connected to a source within the ring's outer distance; at least its neighbours.
  std::vector<int> disc(int source) const;
  /// The fields to transport, as columns: directions away from the source, and the two axes at the source.
  /// @param first the first axis, a unit vector in the frame of the source
  HeatFields startingFields(int source, const std::vector<int>& disc, const Eigen::Vector2d& first) const;
};

LogMapSolver::LogMapSolver(LogMapSolver&&) noexcept = default;
LogMapSolver& LogMapSolver::operator=(LogMapSolver&&) noexcept = default;
LogMapSolver::~LogMapSolver() = default;

LogMapSolver::LogMapSolver(const Laplacian& laplacian, const VectorHeatOptions& options)
    : LogMapSolver(laplacian, laplacian.frames, options) {}

LogMapSolver::LogMapSolver(const Laplacian& laplacian, const Frames& frames, const VectorHeatOptions& options) {
  checkFrames(constructor, laplacian, frames);
  if (!laplacian.hasCover())
    throw InvalidInput(std::string(constructor) + ": the Laplacian has no cover, must have one: keep_cover = true");
  const Stopwatch watch;
  DistanceSolver distance(laplacian, {.solver = options.solver});
  FieldHeat heat(constructor, laplacian, &frames, options, memoryLimit(options.solver.memory_limit));
  SolverReport report = heat.report();
  report.seconds = watch.seconds();
  state_.reset(new State{laplacian.L, laplacian.M, laplacian.positions, frames, std::move(distance), std::move(heat),
                         std::move(report)});
}

const SolverReport& LogMapSolver::report() const {
  return state_->report;
}

Eigen::Vector2d LogMapSolver::State::inPlane(int source, int point) const {
  const Eigen::RowVector3d offset = (positions.row(point) - positions.row(source)) / heat.spacingAt(source);
  const Eigen::RowVector3d normal = frames.normals.row(source), x = frames.tangents.row(source);
  return {x.dot(offset), normal.cross(x).dot(offset)};
}

std::vector<int> LogMapSolver::State::disc(int source) const {
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

HeatFields LogMapSolver::State::startingFields(int source, const std::vector<int>& disc,
                                               const Eigen::Vector2d& first) const {
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

LogMap LogMapSolver::query(int source, const Eigen::RowVector3d& axis, const Progress& progress) const {
  const Stopwatch watch;
  const State& state = *state_;
  const std::string name = std::string(query_name) + ": ";
  const int s = state.heat.place(query_name, source);
  if (s < 0) throw InvalidInput(name + state.heat.whyIgnored(source) + ", lies on no component, must be active");
  if (!axis.allFinite()) throw InvalidInput(name + "axis is not finite, must be");
  Eigen::Vector2d first = inTangentPlane(name + "axis", state.frames, s, axis);
  first = first.norm() > 0 ? Eigen::Vector2d(first.stableNormalized()) : Eigen::Vector2d::UnitX();
  const Eigen::RowVector3d normal = state.frames.normals.row(s), x = state.frames.tangents.row(s), y = normal.cross(x);
  LogMap map;
  map.first = first[0] * x + first[1] * y;
  map.second = first[0] * y - first[1] * x;

  const VectorXd distance = state.distance.query({s}, nullptr, progress);
  const std::vector<int> disc = state.disc(s);
  const HeatFields found = state.heat.spread(query_name, state.startingFields(s, disc, first), map.report, progress);
  map.coordinates.resize(distance.size(), 2);
  for (int i = 0; i < distance.size(); ++i) {
    const auto field = [&](int column) { return found.vectors.col(column).segment<2>(2 * Eigen::Index{i}); };
    const Eigen::Vector2d direction(field(0).dot(field(1)), field(0).dot(field(2)));
    map.coordinates.row(i) = distance[i] * direction.normalized();
  }
  for (const int p : disc) {
    const Eigen::Vector2d place = state.inPlane(s, p);
    if (!(place.norm() > 0 && place.norm() <= ring_begin)) continue;
    const Eigen::Vector2d direction(place.dot(first), first[0] * place[1] - first[1] * place[0]);
    map.coordinates.row(p) = distance[p] * direction.normalized();
  }
  map.coordinates.row(s).setZero();
  state.heat.copyToCoincident(map.coordinates);
  map.report.seconds = watch.seconds();
  return map;
}

}  // namespace tufted
