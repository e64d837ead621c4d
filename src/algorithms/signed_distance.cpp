// Signed distances from curves (Feng, Crane: "A heat method for generalized signed distance", 2024).
#include "tufted/signed_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "algorithms/check_positions.h"
#include "algorithms/connected.h"
#include "algorithms/curve_sides.h"
#include "algorithms/greater.h"
#include "algorithms/linear_system.h"
#include "algorithms/memory_limit.h"
#include "algorithms/place_in_cover.h"
#include "algorithms/vector_heat.h"
#include "base/dense_solvers.h"
#include "base/require.h"
#include "base/stage_clock.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* signed_distance_constructor = "SignedDistanceSolver";
constexpr const char* signed_distance_query = "SignedDistanceSolver::query";
constexpr double unknown_value = std::numeric_limits<double>::quiet_NaN();

/// The part of the memory for the two factors of heat (scalars, vectors); the factor of L gets the rest.
constexpr double heat_share = 0.75;

/// Heat: weights of the means over two curves that differ by less than this part of the greatest are equal.
constexpr double equal_means = 1e-13;

/// Heat: how many solves are made at once for the shifts of curves, which bounds their memory.
constexpr Eigen::Index shifts_at_once = 16;

/// Curves by what of them takes part.
struct Curves {
  std::vector<CurvePlace> places;
  std::vector<CurveSegment> segments;
};

}  // namespace

struct SignedDistanceSolver::State {
  SparseMatrix L;
  Points positions;
  Frames frames;
  Components components;
  std::vector<int> representative;
  std::vector<PointStatus> status;
  std::optional<FieldHeat> heat;        ///< empty: marching
  std::optional<LinearSystem> system;   ///< of L; empty: marching
  std::optional<DistanceSolver> march;  ///< empty: heat
  SolverReport report;

  State(const Laplacian& laplacian, const Frames& given, const SignedDistanceOptions& options);

  /// The places that take part, at representatives.
  std::vector<CurvePlace> placesOf(const std::vector<SurfacePoint>& points) const;
  int componentOf(const CurvePlace& place) const;
  /// @throws InvalidInput for curves without a segment that has a direction in the tangent planes
  Curves resolved(const std::vector<SurfaceCurve>& curves) const;
  /// The direction to the left of a segment in the frame of a point, 0 if it is perpendicular to the tangent plane.
  Eigen::Vector2d leftOf(const CurveSegment& segment, int point) const;
  /// The length of the curves at each point over that of the longest segment, with a column for each curve on each
  /// component.
  SparseMatrix lengthsOf(const std::vector<CurveSegment>& segments) const;
  /// At both ends of each segment its normal to the left flows in, times half its length.
  VectorXd byHeat(const std::vector<CurveSegment>& segments, const SparseMatrix& lengths, const Progress& progress,
                  SignedDistanceReport& made) const;
  /// Solves L x = b so that the mean over each curve is 0 on each component, by sources of equal strength along each.
  VectorXd withMeanZero(VectorXd b, const SparseMatrix& lengths, const Progress& progress,
                        SignedDistanceReport& made) const;
  VectorXd byMarching(const Curves& curves, const std::vector<CurvePlace>& places, const Progress& progress,
                      SignedDistanceReport& made) const;
  /// The right side for the function whose rises along edges are nearest to those of `slope`, by the weights of L.
  /// @param slope N unit vectors; NaN: unknown
  VectorXd divergence(const std::vector<Eigen::RowVector3d>& slope) const;
};

SignedDistanceSolver::State::State(const Laplacian& laplacian, const Frames& given,
                                   const SignedDistanceOptions& options)
    : L(laplacian.L),
      positions(laplacian.positions),
      frames(given),
      components(findComponents(laplacian)),
      representative(laplacian.representative),
      status(laplacian.status) {
  if (options.method == DistanceMethod::marching) {
    march.emplace(laplacian, DistanceOptions{.split = options.split, .solver = options.solver});
    report = march->report();
    return;
  }
  VectorHeatOptions vectors = {.time_step = options.time_step, .solver = options.solver};
  const std::size_t bytes = memoryLimit(options.solver.memory_limit);
  const auto of_heat = static_cast<std::size_t>(heat_share * static_cast<double>(bytes));
  heat.emplace(signed_distance_constructor, laplacian, &frames, vectors, of_heat);
  vectors.solver.memory_limit = bytes - of_heat;
  system.emplace(
      LinearSystem::laplacian({.function = signed_distance_constructor, .matrix = "L"}, laplacian, vectors.solver));
  report = heat->report();
  addReport(system->report(), report);
}

std::vector<CurvePlace> SignedDistanceSolver::State::placesOf(const std::vector<SurfacePoint>& points) const {
  std::vector<CurvePlace> places;
  for (SurfacePoint point : points) {
    checkPlace(signed_distance_query, point, static_cast<int>(representative.size()));
    for (int& corner : point.corners) corner = representative[corner];
    const Eigen::RowVector3d first = positions.row(point.corners[0]);
    Eigen::RowVector3d position = first;
    bool is_active = true;
    for (int k = 0; k < 3; ++k) {
      if (!(point.weights[k] > 0)) continue;
      is_active &= components.of[point.corners[k]] >= 0;
      position += point.weights[k] * (positions.row(point.corners[k]) - first);
    }
    if (is_active) places.push_back({point, position});
  }
  return places;
}

int SignedDistanceSolver::State::componentOf(const CurvePlace& place) const {
  return components.of[place.point.corners[std::max_element(place.point.weights.begin(), place.point.weights.end()) -
                                           place.point.weights.begin()]];
}

Eigen::Vector2d SignedDistanceSolver::State::leftOf(const CurveSegment& segment, int point) const {
  const Eigen::RowVector3d normal = frames.normals.row(point), x = frames.tangents.row(point), y = normal.cross(x);
  const Eigen::Vector2d left(-y.dot(segment.along), x.dot(segment.along));
  return left.norm() > 0 ? left.stableNormalized() : Eigen::Vector2d::Zero();
}

Curves SignedDistanceSolver::State::resolved(const std::vector<SurfaceCurve>& curves) const {
  Curves found;
  bool has_direction = false;
  for (int curve = 0; curve < std::ssize(curves); ++curve) {
    const std::vector<CurvePlace> places = placesOf(curves[curve]);
    for (std::size_t k = 1; k < places.size(); ++k) {
      const Eigen::RowVector3d step = places[k].position - places[k - 1].position;
      const double length = step.stableNorm();
      if (!(length > 0) || componentOf(places[k - 1]) != componentOf(places[k])) continue;
      found.segments.push_back({places[k - 1], places[k], curve, step / length, length});
      for (const int i : places[k].point.corners) has_direction |= !leftOf(found.segments.back(), i).isZero(0);
    }
    found.places.insert(found.places.end(), places.begin(), places.end());
  }
  if (!curves.empty() && !has_direction)
    throw InvalidInput(std::string(signed_distance_query) + ": curve has " + std::to_string(found.places.size()) +
                       " places that take part, must have at least two on one component, and directions along it");
  return found;
}

SparseMatrix SignedDistanceSolver::State::lengthsOf(const std::vector<CurveSegment>& segments) const {
  std::map<std::pair<int, int>, int> column;  // of each curve on each component
  std::vector<Eigen::Triplet<double>> entries;
  double longest = 0;
  for (const CurveSegment& segment : segments) longest = std::max(longest, segment.length);
  for (const CurveSegment& segment : segments) {
    const int c = column.try_emplace({componentOf(segment.from), segment.curve}, std::ssize(column)).first->second;
    for (const CurvePlace* end : {&segment.from, &segment.to})
      for (int k = 0; k < 3; ++k)
        if (end->point.weights[k] > 0)
          entries.emplace_back(end->point.corners[k], c, end->point.weights[k] * (segment.length / longest) / 2);
  }
  SparseMatrix lengths(L.rows(), std::ssize(column));
  lengths.setFromTriplets(entries.begin(), entries.end());
  return lengths;
}

VectorXd SignedDistanceSolver::State::byHeat(const std::vector<CurveSegment>& segments, const SparseMatrix& lengths,
                                             const Progress& progress, SignedDistanceReport& made) const {
  const int n = heat->size();
  HeatFields flow{Eigen::MatrixXd::Zero(n, 1), Eigen::MatrixXd::Zero(2 * Eigen::Index{n}, 1)};
  for (const CurveSegment& segment : segments) {
    for (const CurvePlace* end : {&segment.from, &segment.to}) {
      for (int k = 0; k < 3; ++k) {
        const int i = end->point.corners[k];
        const Eigen::Vector2d left = leftOf(segment, i);
        if (!(end->point.weights[k] > 0) || left.isZero(0)) continue;
        const double share = end->point.weights[k] * (segment.length / heat->spacingAt(i)) / 2;
        flow.vectors.col(0).segment<2>(2 * Eigen::Index{i}) += share * left;
        flow.scalars(i, 0) += share;
      }
    }
  }
  const HeatFields found = heat->spread(signed_distance_query, flow, made.heat, progress);
  std::vector<Eigen::RowVector3d> slope(static_cast<std::size_t>(n), Eigen::RowVector3d::Constant(unknown_value));
  for (const int i : components.points) {
    const Eigen::Vector2d direction = found.vectors.col(0).segment<2>(2 * Eigen::Index{i});
    const Eigen::RowVector3d normal = frames.normals.row(i), x = frames.tangents.row(i);
    if (direction.allFinite()) slope[i] = direction[0] * x + direction[1] * normal.cross(x);
  }
  return withMeanZero(divergence(slope), lengths, progress, made);
}

VectorXd SignedDistanceSolver::State::withMeanZero(VectorXd b, const SparseMatrix& lengths, const Progress& progress,
                                                   SignedDistanceReport& made) const {
  const auto solve = [&](const Eigen::MatrixXd& right) -> Eigen::MatrixXd {
    SolveReport solved;
    Eigen::MatrixXd found = system->solve(signed_distance_query, right, &solved, progress, Refine::where_needed);
    made.residual = greater(made.residual, solved.residual);
    return found;
  };
  // Weights of the mean over each curve, and of its difference from that over the first curve of the component.
  const VectorXd sums = lengths.transpose() * VectorXd::Ones(L.rows());
  const SparseMatrix mean = lengths * sums.cwiseInverse().asDiagonal();
  std::vector<Eigen::Index> first(static_cast<std::size_t>(components.count), -1);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::Index count = 0;
  for (Eigen::Index c = 0; c < mean.cols(); ++c) {
    Eigen::Index& before = first[components.of[SparseMatrix::InnerIterator(mean, c).row()]];
    if (before < 0) {
      before = c;
      continue;
    }
    for (SparseMatrix::InnerIterator entry(mean, c); entry; ++entry)
      entries.emplace_back(entry.row(), count, entry.value());
    for (SparseMatrix::InnerIterator entry(mean, before); entry; ++entry)
      entries.emplace_back(entry.row(), count, -entry.value());
    ++count;
  }
  VectorXd distance = solve(b);
  if (count > 0) {
    SparseMatrix difference(L.rows(), count);
    difference.setFromTriplets(entries.begin(), entries.end());
    // Means over equal curves that are cut differently differ by rounding, which counts as none.
    difference.prune(mean.coeffs().maxCoeff(), equal_means);
    Eigen::MatrixXd answers(count, count);
    for (Eigen::Index c = 0; c < count; c += shifts_at_once) {
      const Eigen::Index columns = std::min(shifts_at_once, count - c);
      answers.middleCols(c, columns) = difference.transpose() * solve(difference.middleCols(c, columns));
    }
    b -= difference * leastSquares(answers, difference.transpose() * distance);
    distance = solve(b);
  }
  const VectorXd means = mean.transpose() * distance;
  for (const int i : components.points) {
    const Eigen::Index c = first[components.of[i]];
    distance[i] = c >= 0 ? distance[i] - means[c] : unknown_value;
  }
  return distance;
}

VectorXd SignedDistanceSolver::State::byMarching(const Curves& curves, const std::vector<CurvePlace>& places,
                                                 const Progress& progress, SignedDistanceReport& made) const {
  std::vector<SurfacePoint> sources;
  for (const auto* list : {&curves.places, &places})
    for (const CurvePlace& place : *list) sources.push_back(place.point);
  // Without sources in the middles, points next to a curve err by up to 0.1 edges instead of 0.03.
  for (const CurveSegment& segment : curves.segments)
    if (const std::optional<SurfacePoint> middle = middleInTriangle(segment, positions)) sources.push_back(*middle);
  VectorXd distance = march->queryAt(sources, &made.march, progress);
  signBySide({.L = L, .positions = positions, .frames = frames, .components = components}, curves.segments, places,
             distance);
  return distance;
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
  SurfaceCurve places;
  places.reserve(curve.size());
  for (const int point : curve) places.push_back(SurfacePoint::vertex(point));
  return queryAt({places}, {}, report, progress);
}

VectorXd SignedDistanceSolver::queryAt(const std::vector<SurfaceCurve>& curves, const std::vector<SurfacePoint>& points,
                                       SignedDistanceReport* report, const Progress& progress) const {
  const Stopwatch watch;
  const State& state = *state_;
  const std::string name = std::string(signed_distance_query) + ": ";
  if (state.heat && !points.empty())
    throw InvalidInput(name + "points has " + std::to_string(points.size()) +
                       " places, must be empty unless method is marching");
  if (curves.empty() && points.empty())
    throw InvalidInput(name + "no curve and no point is given, must be at least one");
  const Curves known = state.resolved(curves);
  const std::vector<CurvePlace> places = state.placesOf(points);
  if (curves.empty() && places.empty())
    throw InvalidInput(
        name + "no point lies on a component, must be at least one active point: " +
        whyOnNone("source", points[0].corners[0], state.status[state.representative[points[0].corners[0]]]));
  SignedDistanceReport made;
  const SparseMatrix lengths = state.lengthsOf(known.segments);
  const VectorXd total = lengths * VectorXd::Ones(lengths.cols());
  made.curve_points = (total.array() > 0).count();
  made.segments = std::ssize(known.segments);
  for (const CurveSegment& segment : known.segments) made.curve_length += segment.length;
  made.long_segments = std::count_if(known.segments.begin(), known.segments.end(), [&](const CurveSegment& segment) {
    return skipsPoints(segment, state.L, state.positions);
  });
  VectorXd distance = state.heat ? state.byHeat(known.segments, lengths, progress, made)
                                 : state.byMarching(known, places, progress, made);
  for (Eigen::Index i = 0; i < distance.size(); ++i) {
    const double found = distance[state.representative[i]];
    distance[i] = state.components.of[state.representative[i]] >= 0 && std::isfinite(found) ? found : unknown_value;
  }
  made.seconds = watch.seconds();
  if (report != nullptr) *report = made;
  return distance;
}

SignedDistanceSolver::SignedDistanceSolver(const Laplacian& laplacian, const SignedDistanceOptions& options)
    : SignedDistanceSolver(laplacian, laplacian.frames, options) {}

SignedDistanceSolver::SignedDistanceSolver(const Laplacian& laplacian, const Frames& frames,
                                           const SignedDistanceOptions& options) {
  const Stopwatch watch;
  checkFrames(signed_distance_constructor, laplacian, frames);
  requireChoice(options.method, DistanceMethod::heat, signed_distance_constructor, "method");
  auto state = std::make_unique<State>(laplacian, frames, options);
  state->report.seconds = watch.seconds();
  state_ = std::move(state);
}

double SignedDistanceSolver::timeStep() const {
  return state_->heat ? state_->heat->timeStep() : 0;
}

const SolverReport& SignedDistanceSolver::report() const {
  return state_->report;
}

}  // namespace tufted
