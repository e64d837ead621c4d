// Geodesic distance by the heat method (Crane, Weischedel, Wardetzky 2013, 2017) on the faces of the tufted cover.
#include "tufted/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "algorithms/connected.h"
#include "algorithms/greater.h"
#include "algorithms/heat_directions.h"
#include "algorithms/linear_system.h"
#include "algorithms/memory_limit.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/stage_clock.h"
#include "cover/face_scale.h"
#include "operators/surface_faces.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// A mass below this part of its row of L is lost when the two are added, and the matrix may become singular.
constexpr double least_mass = 1e-13;

constexpr const char* constructor = "DistanceSolver";
constexpr const char* query_name = "DistanceSolver::query";

void checkArguments(const Laplacian& laplacian, const DistanceOptions& options) {
  checkSizes(constructor, laplacian);
  if (!(options.time_step > 0 && std::isfinite(options.time_step))) {
    throw InvalidInput(std::string(constructor) + ": time_step = " + numberText(options.time_step) +
                       ", must be finite and above 0");
  }
}

/// The cover of a Laplacian, checked, as one that was put together by hand may not fit.
const IntrinsicTriangulation& checkedCover(const Laplacian& laplacian) {
  const std::string name = std::string(constructor) + ": cover ";
  const IntrinsicTriangulation& cover = laplacian.cover();
  const auto n = std::ssize(laplacian.status);
  if (cover.vertices != n)
    throw InvalidInput(name + "has " + std::to_string(cover.vertices) + " vertices, must have " + std::to_string(n));
  if (std::ssize(cover.length) != 3 * cover.size())
    throw InvalidInput(name + "has " + std::to_string(cover.length.size()) + " lengths, must have " +
                       std::to_string(3 * cover.size()));
  for (const auto& face : cover.faces) {
    for (const int corner : face) {
      if (corner >= 0 && corner < n) continue;
      throw InvalidInput(name + "has the corner " + std::to_string(corner) + ", must lie in [0, " + std::to_string(n) +
                         ")");
    }
  }
  return cover;
}

/// The matrix M / t + L of the heat equation, with M from the areas of the faces.
SparseMatrix heatMatrix(const Laplacian& laplacian, const SurfaceFaces& surface, double time) {
  SparseMatrix A = laplacian.L;
  const VectorXd areas = lumpedAreas(surface, static_cast<int>(A.rows()));
  for (int i = 0; i < A.outerSize(); ++i) {
    for (SparseMatrix::InnerIterator entry(A, i); entry; ++entry) {
      if (entry.row() == i) entry.valueRef() += std::max(least_mass * entry.value(), areas[i] / time);
    }
  }
  return A;
}

void checkSource(const SurfacePoint& source, int n) {
  const std::string name = std::string(query_name) + ": ";
  for (int k = 0; k < 3; ++k) {
    if (source.corners[k] < 0 || source.corners[k] >= n) {
      throw InvalidInput(name + "source " + std::to_string(source.corners[k]) + ", must lie in [0, " +
                         std::to_string(n) + ")");
    }
    if (!(source.weights[k] >= 0 && source.weights[k] <= 1)) {
      throw InvalidInput(name + "weight of a source = " + numberText(source.weights[k]) + ", must lie in [0, 1]");
    }
    if (!(source.distances[k] >= 0 && std::isfinite(source.distances[k]))) {
      throw InvalidInput(name + "distance of a source from a corner = " + numberText(source.distances[k]) +
                         ", must be finite and at least 0");
    }
  }
}

/// Distance and heat that the sources give, by active point.
struct Sources {
  VectorXd distance;  ///< in the solver's unit; infinite away from sources
  VectorXd heat;
};

}  // namespace

struct DistanceSolver::State {
  SparseMatrix L;
  SurfaceFaces surface;
  Components components;
  std::vector<int> representative;
  double time = 1;  ///< in units of 2^(2 exponent)
  int threads = 0;
  HeatSystem heat;
  std::optional<const LinearSystem> poisson;
  SolverReport report;

  Sources locate(const std::vector<SurfacePoint>& sources) const;
  std::vector<std::uint8_t> facesInside(const Sources& sources) const;
  void shift(const Sources& sources, VectorXd& distance) const;
};

DistanceSolver::DistanceSolver(DistanceSolver&&) noexcept = default;
DistanceSolver& DistanceSolver::operator=(DistanceSolver&&) noexcept = default;
DistanceSolver::~DistanceSolver() = default;

DistanceSolver::DistanceSolver(const Laplacian& laplacian, const DistanceOptions& options) {
  checkArguments(laplacian, options);
  const Stopwatch watch;
  auto state = std::make_unique<State>();
  const Workers workers(options.solver.threads, options.solver.progress);
  state->L = laplacian.L;
  state->surface = distinctFaces(checkedCover(laplacian), faceScale(laplacian.kind), workers);
  state->components = findComponents(laplacian);
  state->representative = laplacian.representative;
  state->threads = options.solver.threads;
  const SurfaceFaces& surface = state->surface;
  const double unit = options.unit == TimeUnit::mean_edge ? surface.mean_square : surface.area_mean_square;
  if (unit > 0) state->time = options.time_step * unit;

  const Eigen::Index n = laplacian.L.rows();
  VectorXd interior;
  const auto isInner = [](Boundary boundary) { return boundary == Boundary::none; };
  if (options.open_boundary && !std::all_of(laplacian.boundary.begin(), laplacian.boundary.end(), isInner)) {
    interior.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) interior[i] = isInner(laplacian.boundary[i]) ? 1 : 0;
  }
  // All factors are held at once, and are about as large.
  const int factors = interior.size() > 0 ? 3 : 2;
  SolverOptions one = options.solver;
  one.memory_limit = std::max<std::size_t>(memoryLimit(options.solver.memory_limit) / factors, 1);
  state->heat = makeHeatSystem(constructor, heatMatrix(laplacian, surface, state->time), std::move(interior), one);
  state->poisson.emplace(LinearSystem::laplacian({.function = constructor, .matrix = "L"}, laplacian, one));
  for (const LinearSystem* held : {state->heat.closed.get(), state->heat.open.get(), &*state->poisson})
    if (held != nullptr) addReport(held->report(), state->report);
  state->report.seconds = watch.seconds();
  state_ = std::move(state);
}

double DistanceSolver::timeStep() const {
  return std::ldexp(state_->time, 2 * state_->surface.exponent);
}

const SolverReport& DistanceSolver::report() const {
  return state_->report;
}

Sources DistanceSolver::State::locate(const std::vector<SurfacePoint>& sources) const {
  const int n = static_cast<int>(representative.size());
  if (sources.empty()) throw InvalidInput(std::string(query_name) + ": sources is empty, must name at least one");
  Sources found{VectorXd::Constant(n, infinity), VectorXd::Zero(n)};
  for (const SurfacePoint& source : sources) {
    checkSource(source, n);
    for (int k = 0; k < 3; ++k) {
      const int i = representative[source.corners[k]];
      if (components.of[i] < 0) continue;
      // The greater heat and not the sum, so that a source counts once.
      found.distance[i] = std::min(found.distance[i], std::ldexp(source.distances[k], -surface.exponent));
      found.heat[i] = std::max(found.heat[i], source.weights[k]);
    }
  }
  if (!(found.heat.maxCoeff() > 0)) {
    throw InvalidInput(std::string(query_name) + ": no source lies on a component, must be at least one active point");
  }
  return found;
}

/// Marks the faces inside a region of sources, where the gradient has no direction.
std::vector<std::uint8_t> DistanceSolver::State::facesInside(const Sources& sources) const {
  std::vector<std::uint8_t> inside(surface.faces.size(), 0);
  for (std::size_t f = 0; f < inside.size(); ++f) {
    const auto& [a, b, c] = surface.faces[f].corners;
    const bool all = sources.distance[a] == 0 && sources.distance[b] == 0 && sources.distance[c] == 0;
    inside[f] = all ? 1 : 0;
  }
  return inside;
}

/// Turns a function that is right up to a constant per component into distances, in the points' unit.
void DistanceSolver::State::shift(const Sources& sources, VectorXd& distance) const {
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
  for (Eigen::Index i = 0; i < distance.size(); ++i) distance[i] = distance[representative[i]];
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
  const Stopwatch watch;
  const State& state = *state_;
  const Sources known = state.locate(sources);
  const HeatProblem problem{state.surface, state.L, state.components, state.heat};
  DistanceReport made;
  VectorXd distance =
      divergenceOfHeat(query_name, problem, known.heat, state.facesInside(known), state.threads, progress, made);
  const Eigen::MatrixXd scale = state.components.normalise(distance);
  SolveReport solved;
  distance = state.poisson->solve(query_name, distance, &solved, progress);
  state.components.multiply(distance, scale);
  state.shift(known, distance);
  if (report != nullptr) {
    made.iterations = std::max(made.iterations, solved.iterations);
    made.residual = greater(made.residual, solved.residual);
    made.backward_error = greater(made.backward_error, solved.backward_error);
    made.weak_joint = solved.weak_joint;
    made.seconds = watch.seconds();
    *report = made;
  }
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
  SurfacePoint result{{triangles(face, 0), triangles(face, 1), triangles(face, 2)}, {}, {}};
  const Eigen::RowVector3d origin = points.row(result.corners[0]);
  Eigen::RowVector3d place = Eigen::RowVector3d::Zero();  // from the first corner
  for (int k = 0; k < 3; ++k) {
    result.weights[k] = barycentric[k] / sum;
    place += result.weights[k] * (points.row(result.corners[k]) - origin);
  }
  for (int k = 0; k < 3; ++k) result.distances[k] = (place - (points.row(result.corners[k]) - origin)).norm();
  return result;
}

}  // namespace tufted
