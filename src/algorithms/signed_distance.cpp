// Signed distances from curves (Feng, Crane: "A heat method for generalized signed distance", 2024).
#include "tufted/signed_distance.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "algorithms/check_positions.h"
#include "algorithms/connected.h"
#include "algorithms/linear_system.h"
#include "algorithms/memory_limit.h"
#include "algorithms/vector_heat.h"
#include "base/stage_clock.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* constructor = "SignedDistanceSolver";
constexpr const char* query_name = "SignedDistanceSolver::query";
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The part of the memory for the two factors of heat (scalars, vectors); the factor of L gets the rest.
constexpr double heat_share = 0.75;

std::size_t shareOf(std::size_t bytes, double share) {
  return static_cast<std::size_t>(share * static_cast<double>(bytes));
}

VectorHeatOptions withMemory(VectorHeatOptions options, std::size_t bytes) {
  options.solver.memory_limit = bytes;
  return options;
}

}  // namespace

struct SignedDistanceSolver::State {
  SparseMatrix L;
  Points positions;
  Frames frames;
  Components components;
  FieldHeat heat;
  LinearSystem system;
  SolverReport report;

  State(const Laplacian& laplacian, Frames given, const VectorHeatOptions& options, std::size_t bytes)
      : L(laplacian.L),
        positions(laplacian.positions),
        frames(std::move(given)),
        components(findComponents(laplacian)),
        heat(constructor, laplacian, &frames, options, shareOf(bytes, heat_share)),
        system(LinearSystem::laplacian({.function = constructor, .matrix = "L"}, laplacian,
                                       withMemory(options, shareOf(bytes, 1 - heat_share)).solver)),
        report(heat.report()) {
    addReport(system.report(), report);
  }

  /// The representatives of active points of the curve, without consecutive repetitions.
  std::vector<int> placesOf(const std::vector<int>& curve) const;
  /// The fields to transport: at both ends of each segment of the curve its normal to the left, times half its length.
  /// @param[out] length N; of the curve at each point, in units of spacingAt()
  HeatFields flowOf(const std::vector<int>& places, VectorXd& length, SignedDistanceReport& made) const;
  /// The right side for the function whose rises along edges are nearest to those of `slope`, by the weights of L.
  /// @param slope N unit vectors; NaN: unknown
  VectorXd divergence(const std::vector<Eigen::RowVector3d>& slope) const;
};

std::vector<int> SignedDistanceSolver::State::placesOf(const std::vector<int>& curve) const {
  std::vector<int> places;
  for (const int point : curve) {
    const int i = heat.place(query_name, point);
    if (i >= 0 && (places.empty() || places.back() != i)) places.push_back(i);
  }
  return places;
}

HeatFields SignedDistanceSolver::State::flowOf(const std::vector<int>& places, VectorXd& length,
                                               SignedDistanceReport& made) const {
  const int n = heat.size();
  HeatFields flow{Eigen::MatrixXd::Zero(n, 1), Eigen::MatrixXd::Zero(2 * Eigen::Index{n}, 1)};
  length.setZero(n);
  bool has_direction = false;
  for (std::size_t k = 1; k < places.size(); ++k) {
    const int ends[2] = {places[k - 1], places[k]};
    if (components.of[ends[0]] != components.of[ends[1]]) continue;
    const double unit = heat.spacingAt(ends[0]);
    const Eigen::RowVector3d segment = (positions.row(ends[1]) - positions.row(ends[0])) / unit;
    const double size = segment.stableNorm();
    made.curve_length += size * unit;
    for (const int i : ends) {
      length[i] += size / 2;
      const Eigen::RowVector3d normal = frames.normals.row(i), x = frames.tangents.row(i), y = normal.cross(x);
      const Eigen::Vector2d along(x.dot(segment), y.dot(segment)), left(-along[1], along[0]);
      if (!(along.norm() > 0)) continue;
      flow.vectors.col(0).segment<2>(2 * Eigen::Index{i}) += size / 2 * left.stableNormalized();
      flow.scalars(i, 0) += size / 2;
      has_direction = true;
    }
  }
  if (!has_direction)
    throw InvalidInput(std::string(query_name) + ": curve has " + std::to_string(places.size()) +
                       " places that take part, must have at least two on one component, and directions along it");
  for (Eigen::Index i = 0; i < n; ++i) made.curve_points += length[i] > 0 ? 1 : 0;
  return flow;
}

VectorXd SignedDistanceSolver::State::divergence(const std::vector<Eigen::RowVector3d>& slope) const {
  VectorXd b = VectorXd::Zero(L.rows());
  for (const int i : components.points) {
    if (!slope[i].allFinite()) continue;
    for (SparseMatrix::InnerIterator entry(L, i); entry; ++entry) {
      const auto j = entry.row();
      if (j == i || !slope[j].allFinite()) continue;
      // Rise of the distance from i to j.
      const double rise = (slope[i] + slope[j]).dot(positions.row(j) - positions.row(i)) / 2;
      b[i] += entry.value() * rise;
    }
  }
  return b;
}

VectorXd SignedDistanceSolver::query(const std::vector<int>& curve, SignedDistanceReport* report,
                                     const Progress& progress) const {
  const Stopwatch watch;
  const State& state = *state_;
  SignedDistanceReport made;
  VectorXd length;
  const HeatFields flow = state.flowOf(state.placesOf(curve), length, made);
  const HeatFields found = state.heat.spread(query_name, flow, made.heat, progress);
  std::vector<Eigen::RowVector3d> slope(static_cast<std::size_t>(state.heat.size()), Eigen::RowVector3d::Constant(nan));
  for (const int i : state.components.points) {
    const Eigen::Vector2d direction = found.vectors.col(0).segment<2>(2 * Eigen::Index{i});
    const Eigen::RowVector3d normal = state.frames.normals.row(i), x = state.frames.tangents.row(i);
    if (direction.allFinite()) slope[i] = direction[0] * x + direction[1] * normal.cross(x);
  }
  SolveReport solved;
  Eigen::MatrixXd distance =
      state.system.solve(query_name, state.divergence(slope), &solved, progress, Refine::where_needed);
  made.residual = solved.residual;

  // Shifts the distance on each component to mean 0 over the curve.
  VectorXd sum = VectorXd::Zero(state.components.count), weight = sum;
  for (const int i : state.components.points) {
    sum[state.components.of[i]] += length[i] * distance(i, 0);
    weight[state.components.of[i]] += length[i];
  }
  for (Eigen::Index i = 0; i < distance.rows(); ++i) {
    const int c = state.components.of[i];
    distance(i, 0) = c >= 0 && weight[c] > 0 ? distance(i, 0) - sum[c] / weight[c] : nan;
  }
  state.heat.copyToCoincident(distance);
  made.seconds = watch.seconds();
  if (report != nullptr) *report = made;
  return distance.col(0);
}

SignedDistanceSolver::SignedDistanceSolver(const Laplacian& laplacian, const VectorHeatOptions& options)
    : SignedDistanceSolver(laplacian, laplacian.frames, options) {}

SignedDistanceSolver::SignedDistanceSolver(const Laplacian& laplacian, const Frames& frames,
                                           const VectorHeatOptions& options) {
  const Stopwatch watch;
  checkFrames(constructor, laplacian, frames);
  auto state = std::make_unique<State>(laplacian, frames, options, memoryLimit(options.solver.memory_limit));
  state->report.seconds = watch.seconds();
  state_ = std::move(state);
}

double SignedDistanceSolver::timeStep() const {
  return state_->heat.timeStep();
}

const SolverReport& SignedDistanceSolver::report() const {
  return state_->report;
}

SignedDistanceSolver::SignedDistanceSolver(SignedDistanceSolver&&) noexcept = default;
SignedDistanceSolver& SignedDistanceSolver::operator=(SignedDistanceSolver&&) noexcept = default;
SignedDistanceSolver::~SignedDistanceSolver() = default;

}  // namespace tufted
