#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tufted/tufted.h"

namespace tufted::support {

/// An algorithm with its arguments.
struct Algorithm {
  std::string name;
  /// Whether values on a component depend only on that component; eigenpairs depend on the whole surface.
  bool is_local;
  int power;                        ///< values scale with this power of the unit of length
  std::optional<double> elsewhere;  ///< value at points that take no part, if it is one for all
  /// @param points those that the Laplacian was built from
  /// @return N x c; absolute values if signs depend on those of normals
  std::function<Eigen::MatrixXd(const Laplacian& laplacian, const Points& points)> run;
};

/// All algorithms that use a cloud's Laplacian, with sources among the first 60 points, which must be on one component.
/// @param threads on which they run, 0: all
/// @param unit of length, of which pointsWithin() finds points within half; its value elsewhere is minus that
inline std::vector<Algorithm> algorithms(int threads = 0, double unit = 1) {
  using Eigen::MatrixXd;
  const std::vector<int> sources = {3, 40};
  const Pins pins{sources, MatrixXd{{1}, {3}}};
  const SolverOptions solver = {.threads = threads};
  const VectorHeatOptions vector_heat = {.solver = solver};
  const auto heat = [=](TimeUnit time) {
    return [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
      return DistanceSolver(laplacian, {.method = DistanceMethod::heat, .unit = time, .solver = solver}).query(sources);
    };
  };
  const auto smoothed = [](const SmoothingOptions& options) {
    return [options](const Laplacian& laplacian, const Points& points) { return smooth(laplacian, points, options); };
  };
  const auto eigenpairs = [=](const Laplacian& laplacian) {
    return spectrum(laplacian, 6, {.null_space = false, .threads = threads});
  };
  return {{"smooth", true, 1, {}, smoothed({.solver = solver})},
          {"smooth by Taubin",
           true,
           1,
           {},
           smoothed({.method = SmoothingMethod::taubin, .iterations = 3, .solver = solver})},
          {"smoothValues",
           true,
           1,
           {},
           [=](const Laplacian& laplacian, const Points& points) {
             return smoothValues(laplacian, points.col(0), {.time_step = 3, .solver = solver});
           }},
          {"SmoothingSolver by multigrid",
           true,
           1,
           {},
           [=](const Laplacian& laplacian, const Points& points) -> MatrixXd {
             const SolverOptions multigrid = {
                 .method = SolverMethod::multigrid, .tolerance = 1e-10, .threads = threads};
             return SmoothingSolver(laplacian, {.time_step = 2, .solver = multigrid}).query(points);
           }},
          {"curvature", true, -1, 0,
           [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
             return curvatures(laplacian, {.threads = threads}).principal.cwiseAbs().rowwise().sum();
           }},
          {"curvature by the Laplacian", true, -1, 0,
           [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
             return curvatures(laplacian, {.method = CurvatureMethod::laplacian, .threads = threads}).mean.cwiseAbs();
           }},
          {"distance by heat", true, 1, INFINITY, heat(TimeUnit::mean_edge)},
          {"distance by heat, adapted", true, 1, INFINITY, heat(TimeUnit::adapted_edge)},
          {"distance by marching", true, 1, INFINITY,
           [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
             return DistanceSolver(laplacian, {.solver = solver}).query(sources);
           }},
          {"DistanceSolver::matrix", true, 1, INFINITY,
           [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
             const std::vector<SurfacePoint> places = {SurfacePoint::vertex(3), SurfacePoint::vertex(40)};
             return DistanceSolver(laplacian, {.solver = solver}).matrix(places, true);
           }},
          {"pointsWithin", true, 1, -1,
           [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
             MatrixXd distance = MatrixXd::Constant(std::ssize(laplacian.status), 1, -unit);
             const NearbyPoints near = pointsWithin(laplacian, {3}, 0.5 * unit);
             for (std::size_t k = 0; k < near.points.size(); ++k) distance(near.points[k], 0) = near.distances[k];
             return distance;
           }},
          {"path",
           true,
           1,
           {},
           [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
             return MatrixXd::Constant(1, 1, PathSolver(laplacian, {.threads = threads}).query(3, 40).length);
           }},
          {"extension", true, 0, NAN,
           [=](const Laplacian& laplacian, const Points&) {
             return ExtensionSolver(laplacian, vector_heat).query(sources, pins.values);
           }},
          {"transport", true, 0, 0,
           [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
             return TransportSolver(laplacian, vector_heat).query({3}, Points{{1, 2, 3}});
           }},
          {"logarithmic map", true, 1, NAN,
           [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
             return LogMapSolver(laplacian).query(3, {1, 2, 3}).coordinates.cwiseAbs();
           }},
          {"logarithmic map by heat", true, 1, NAN,
           [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
             const LogMapOptions options = {.method = LogMapMethod::heat, .solver = solver};
             return LogMapSolver(laplacian, options).query(3, {1, 2, 3}).coordinates.cwiseAbs();
           }},
          {"signed distance", true, 1, NAN,
           [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
             const Frames frames = orientedFrames(laplacian, {.threads = threads});
             return SignedDistanceSolver(laplacian, frames, {.solver = solver}).query({3, 40, 50, 3}).cwiseAbs();
           }},
          {"signed distance by marching", true, 1, NAN,
           [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
             const Frames frames = orientedFrames(laplacian, {.threads = threads});
             const SignedDistanceOptions marching = {.method = DistanceMethod::marching, .solver = solver};
             return SignedDistanceSolver(laplacian, frames, marching).query({3, 40, 50, 3}).cwiseAbs();
           }},
          {"harmonic", true, 0, NAN,
           [=](const Laplacian& laplacian, const Points&) { return harmonic(laplacian, pins, solver); }},
          {"biharmonic", true, 0, NAN,
           [=](const Laplacian& laplacian, const Points&) { return biharmonic(laplacian, pins, solver); }},
          {"poisson", true, 3, NAN,
           [=](const Laplacian& laplacian, const Points& points) { return poisson(laplacian, points.col(0), solver); }},
          {"greensFunction", true, 0, NAN,
           [=](const Laplacian& laplacian, const Points&) { return greensFunction(laplacian, {3}, solver); }},
          {"weights", true, 0, NAN,
           [=](const Laplacian& laplacian, const Points&) {
             return boundedBiharmonicWeights(laplacian, {{3}, {40}}, {.solver = solver});
           }},
          {"deform",
           true,
           1,
           {},
           [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
             return deform(laplacian, sources, Points(1.5 * laplacian.positions(sources, Eigen::all)),
                           {.tolerance = 1e-9, .max_iterations = 1000, .solver = solver});
           }},
          {"orientedFrames",
           true,
           0,
           {},
           [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
             return orientedFrames(laplacian, {.threads = threads}).normals;
           }},
          {"gradients", true, 0, 0,
           [=](const Laplacian& laplacian, const Points& points) -> MatrixXd {
             const Gradients found = gradients(laplacian, laplacian.positions, {.threads = threads});
             const VectorXd u = points.col(0);
             return ((found.X * u).array().square() + (found.Y * u).array().square()).sqrt();
           }},
          {"surfaceTriangles",
           false,
           0,
           {},
           [](const Laplacian& laplacian, const Points&) -> MatrixXd {
             return surfaceTriangles(laplacian).cast<double>();
           }},
          {"spectrum", false, -1, 0,
           [=](const Laplacian& laplacian, const Points&) { return eigenpairs(laplacian).vectors; }},
          {"heat signature", false, -2, 0,
           [=](const Laplacian& laplacian, const Points&) {
             const Spectrum found = eigenpairs(laplacian);
             return heatKernelSignature(laplacian, found, heatTimes(found, 4));
           }},
          {"segments", false, 0, -1, [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
             const std::vector<int> labels = segments(laplacian, {.count = 5, .solver = solver}).labels;
             return Eigen::Map<const Eigen::VectorXi>(labels.data(), std::ssize(labels)).cast<double>();
           }}};
}

/// The greatest difference between finite values of the first rows, by the greatest value.
inline double difference(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  const Eigen::MatrixXd part = found.topRows(expected.rows());
  double most = 0, size = 0;
  for (Eigen::Index i = 0; i < expected.size(); ++i) {
    const double a = expected.data()[i], b = part.data()[i];
    if (std::isfinite(a) != std::isfinite(b)) return INFINITY;
    if (!std::isfinite(a)) continue;
    most = std::max(most, std::abs(a - b));
    size = std::max(size, std::abs(a));
  }
  return most / size;
}

}  // namespace tufted::support
