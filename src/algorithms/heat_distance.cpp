// Geodesic distance by the heat method (Crane, Weischedel, Wardetzky 2013, 2017) on the faces of the tufted cover.
#include "algorithms/heat_distance.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "algorithms/connected.h"
#include "algorithms/greater.h"
#include "algorithms/heat_directions.h"
#include "algorithms/linear_system.h"
#include "algorithms/memory_limit.h"
#include "base/infinity.h"
#include "base/parallel.h"
#include "cover/face_scale.h"
#include "operators/surface_faces.h"

namespace tufted {
namespace {

constexpr const char* heat_distance_constructor = "DistanceSolver";

/// The matrix M / t + L of the heat equation, M being the lumped areas of the faces.
/// @param time of each component
SparseMatrix heatMatrix(const Laplacian& laplacian, const SurfaceFaces& surface, const Components& components,
                        const VectorXd& time) {
  SparseMatrix A = laplacian.L;
  const VectorXd areas = lumpedAreas(surface, static_cast<int>(A.rows()));
  for (const int i : components.points) {
    for (SparseMatrix::InnerIterator entry(A, i); entry; ++entry) {
      if (entry.row() == i) entry.valueRef() += std::max(least_mass * entry.value(), areas[i] / time[components.of[i]]);
    }
  }
  return A;
}

/// Distance and heat at the points next to sources, N each.
struct Sources {
  VectorXd distance;  ///< in the solver's unit; infinite away from sources
  VectorXd heat;
};

}  // namespace

struct HeatDistance::State {
  SparseMatrix L;
  SurfaceFaces surface;
  const Components& components;
  VectorXd time;  ///< of each component, in units of 2^(2 exponent)
  int threads = 0;
  HeatSystem heat;
  std::optional<const LinearSystem> poisson;
  SolverReport report;

  Sources locate(const std::vector<PlaceInCover>& places) const;
  std::vector<std::uint8_t> facesInside(const Sources& sources) const;
  void shift(const Sources& sources, VectorXd& distance) const;
};

HeatDistance::~HeatDistance() = default;

HeatDistance::HeatDistance(const Laplacian& laplacian, const Components& components, const DistanceOptions& options)
    : state_(new State{.L = laplacian.L,
                       .surface = {},
                       .components = components,
                       .time = {},
                       .heat = {},
                       .poisson = {},
                       .report = {}}) {
  State& state = *state_;
  const Workers workers(options.solver.threads, options.solver.progress);
  state.surface =
      surfaceFaces(*laplacian.cover_source, static_cast<int>(laplacian.L.rows()), faceScale(laplacian.kind), workers);
  state.threads = options.solver.threads;
  const SurfaceFaces& surface = state.surface;
  const VectorXd unit =
      meanSquaredSides(surface, components.of, components.count, options.unit == TimeUnit::adapted_edge);
  state.time = (unit.array() > 0).select(options.time_step * unit, 1);

  const Eigen::Index n = laplacian.L.rows();
  VectorXd interior;
  const auto isInner = [](Boundary boundary) { return boundary == Boundary::none; };
  if (options.open_boundary && !std::all_of(laplacian.boundary.begin(), laplacian.boundary.end(), isInner)) {
    interior.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) interior[i] = isInner(laplacian.boundary[i]) ? 1 : 0;
  }
  // All factors are held at once, and have about the same size.
  const int factors = interior.size() > 0 ? 3 : 2;
  SolverOptions one = options.solver;
  one.memory_limit = std::max<std::size_t>(memoryLimit(options.solver.memory_limit) / factors, 1);
  state.heat = makeHeatSystem(heat_distance_constructor, heatMatrix(laplacian, surface, components, state.time),
                              std::move(interior), one);
  state.poisson.emplace(
      LinearSystem::laplacian({.function = heat_distance_constructor, .matrix = "L"}, laplacian, one));
  for (const LinearSystem* held : {state.heat.closed.get(), state.heat.open.get(), &*state.poisson})
    if (held != nullptr) addReport(held->report(), state.report);
}

double HeatDistance::timeStep() const {
  const int largest = state_->components.largest();
  return largest < 0 ? 0 : std::ldexp(state_->time[largest], 2 * state_->surface.exponent);
}

const SolverReport& HeatDistance::report() const {
  return state_->report;
}

Sources HeatDistance::State::locate(const std::vector<PlaceInCover>& places) const {
  const auto n = L.rows();
  Sources found{VectorXd::Constant(n, infinity), VectorXd::Zero(n)};
  for (const PlaceInCover& place : places) {
    const SurfacePoint& point = place.point;
    for (int k = 0; k < 3; ++k) {
      const int i = point.corners[k];
      if (components.of[i] < 0) continue;
      found.distance[i] = std::min(found.distance[i], std::ldexp(point.distances[k], -surface.exponent));
      double heat = 0;  // summed, as after flips a face may have a corner twice
      for (int m = 0; m < 3; ++m)
        if (point.corners[m] == i) heat += point.weights[m];
      // The maximum of repeated sources, not their sum, so that each counts once.
      found.heat[i] = std::max(found.heat[i], heat);
    }
  }
  return found;
}

/// Marks the faces whose corners are all sources, where the gradient has no direction.
std::vector<std::uint8_t> HeatDistance::State::facesInside(const Sources& sources) const {
  std::vector<std::uint8_t> inside(surface.faces.size(), 0);
  for (std::size_t f = 0; f < inside.size(); ++f) {
    const auto& [a, b, c] = surface.faces[f].corners;
    const bool all = sources.distance[a] == 0 && sources.distance[b] == 0 && sources.distance[c] == 0;
    inside[f] = all ? 1 : 0;
  }
  return inside;
}

/// Shifts a function, known up to a constant per component, to the distances at sources, in the points' unit; infinite
/// on components without a source.
void HeatDistance::State::shift(const Sources& sources, VectorXd& distance) const {
  VectorXd excess = VectorXd::Zero(distance.size()), count = VectorXd::Zero(distance.size());
  for (const int i : components.points) {
    if (sources.distance[i] == infinity) continue;
    excess[i] = distance[i] - sources.distance[i];
    count[i] = 1;
  }
  const VectorXd sums = components.sums(excess), counts = components.sums(count);
  for (Eigen::Index i = 0; i < distance.size(); ++i) {
    const int component = components.of[i];
    if (component < 0 || counts[component] == 0) {
      distance[i] = infinity;
    } else {
      const double here = std::max(0.0, distance[i] - sums[component] / counts[component]);
      distance[i] = std::ldexp(std::isfinite(sources.distance[i]) ? sources.distance[i] : here, surface.exponent);
    }
  }
}

VectorXd HeatDistance::query(const char* function, const std::vector<PlaceInCover>& places, const Progress& progress,
                             DistanceReport& report) const {
  const State& state = *state_;
  const Sources known = state.locate(places);
  const HeatProblem problem{state.surface, state.L, state.components, state.heat};
  VectorXd distance =
      divergenceOfHeat(function, problem, known.heat, state.facesInside(known), state.threads, progress, report);
  const Eigen::MatrixXd scale = state.components.normalise(distance);
  SolveReport solved;
  distance = state.poisson->solve(function, distance, &solved, progress);
  state.components.multiply(distance, scale);
  state.shift(known, distance);
  report.iterations = std::max(report.iterations, solved.iterations);
  report.residual = greater(report.residual, solved.residual);
  report.backward_error = greater(report.backward_error, solved.backward_error);
  if (solved.weak_joint) report.weak_joint = solved.weak_joint;
  return distance;
}

}  // namespace tufted
