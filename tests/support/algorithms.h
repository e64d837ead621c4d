#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tufted/tufted.h"

namespace tufted::support {

/// An algorithm with its arguments.
struct Algorithm {
  std::string name;
  /// Whether values on a component depend only on that component; eigenpairs depend on the whole surface.
  bool is_local;
  /// @param points those that the Laplacian was built from
  /// @return N x c; absolute values if signs depend on those of normals
  std::function<Eigen::MatrixXd(const Laplacian& laplacian, const Points& points)> run;
};

/// All algorithms that use a cloud's Laplacian, with sources among the first 60 points, which must be on one component.
inline std::vector<Algorithm> algorithms() {
  using Eigen::MatrixXd;
  const std::vector<int> sources = {3, 40};
  const Pins pins{sources, MatrixXd{{1}, {3}}};
  const auto size = [](const Laplacian& laplacian) { return std::ssize(laplacian.status); };
  const auto heat = [=](TimeUnit unit) {
    return [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
      return DistanceSolver(laplacian, {.method = DistanceMethod::heat, .unit = unit}).query(sources);
    };
  };
  return {
      {"smooth", true, [](const Laplacian& laplacian, const Points& points) { return smooth(laplacian, points); }},
      {"smooth by Taubin", true,
       [](const Laplacian& laplacian, const Points& points) {
         return smooth(laplacian, points, {.method = SmoothingMethod::taubin, .iterations = 3});
       }},
      {"smoothValues", true,
       [](const Laplacian& laplacian, const Points& points) {
         return smoothValues(laplacian, points.col(0), {.time_step = 3});
       }},
      {"SmoothingSolver by multigrid", true,
       [](const Laplacian& laplacian, const Points& points) -> MatrixXd {
         const SolverOptions options = {.method = SolverMethod::multigrid, .tolerance = 1e-10};
         return SmoothingSolver(laplacian, {.time_step = 2, .solver = options}).query(points);
       }},
      {"curvature", true,
       [](const Laplacian& laplacian, const Points&) -> MatrixXd {
         return curvatures(laplacian).principal.cwiseAbs().rowwise().sum();
       }},
      {"curvature by the Laplacian", true,
       [](const Laplacian& laplacian, const Points&) -> MatrixXd {
         return curvatures(laplacian, {.method = CurvatureMethod::laplacian}).mean.cwiseAbs();
       }},
      {"distance by heat", true, heat(TimeUnit::mean_edge)},
      {"distance by heat, adapted", true, heat(TimeUnit::adapted_edge)},
      {"distance by marching", true,
       [=](const Laplacian& laplacian, const Points&) -> MatrixXd { return DistanceSolver(laplacian).query(sources); }},
      {"pointsWithin", true,
       [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
         MatrixXd distance = MatrixXd::Constant(size(laplacian), 1, -1);
         const NearbyPoints near = pointsWithin(laplacian, {3}, 0.5);
         for (std::size_t k = 0; k < near.points.size(); ++k) distance(near.points[k], 0) = near.distances[k];
         return distance;
       }},
      {"path", true,
       [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
         return MatrixXd::Constant(1, 1, PathSolver(laplacian).query(3, 40).length);
       }},
      {"extension", true,
       [=](const Laplacian& laplacian, const Points&) {
         return ExtensionSolver(laplacian).query(sources, pins.values);
       }},
      {"transport", true,
       [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
         return TransportSolver(laplacian).query({3}, Points{{1, 2, 3}});
       }},
      {"logarithmic map", true,
       [](const Laplacian& laplacian, const Points&) -> MatrixXd {
         return LogMapSolver(laplacian).query(3, {1, 2, 3}).coordinates.cwiseAbs();
       }},
      {"signed distance", true,
       [](const Laplacian& laplacian, const Points&) -> MatrixXd {
         return SignedDistanceSolver(laplacian, orientedFrames(laplacian)).query({3, 40, 50, 3}).cwiseAbs();
       }},
      {"harmonic", true, [=](const Laplacian& laplacian, const Points&) { return harmonic(laplacian, pins); }},
      {"biharmonic", true, [=](const Laplacian& laplacian, const Points&) { return biharmonic(laplacian, pins); }},
      {"poisson", true,
       [](const Laplacian& laplacian, const Points& points) { return poisson(laplacian, points.col(0)); }},
      {"greensFunction", true,
       [](const Laplacian& laplacian, const Points&) { return greensFunction(laplacian, {3}); }},
      {"weights", true,
       [](const Laplacian& laplacian, const Points&) {
         return boundedBiharmonicWeights(laplacian, {{3}, {40}});
       }},
      {"deform", true,
       [=](const Laplacian& laplacian, const Points&) -> MatrixXd {
         return deform(laplacian, sources, Points(1.5 * laplacian.positions(sources, Eigen::all)),
                       {.tolerance = 1e-9, .max_iterations = 1000});
       }},
      {"orientedFrames", true,
       [](const Laplacian& laplacian, const Points&) -> MatrixXd { return orientedFrames(laplacian).normals; }},
      {"gradients", true,
       [](const Laplacian& laplacian, const Points& points) -> MatrixXd {
         const Gradients found = gradients(laplacian, laplacian.positions);
         const VectorXd u = points.col(0);
         return ((found.X * u).array().square() + (found.Y * u).array().square()).sqrt();
       }},
      {"surfaceTriangles", false,
       [](const Laplacian& laplacian, const Points&) -> MatrixXd {
         return surfaceTriangles(laplacian).cast<double>();
       }},
      {"spectrum", false,
       [](const Laplacian& laplacian, const Points&) { return spectrum(laplacian, 6, {.null_space = false}).vectors; }},
      {"heat signature", false,
       [](const Laplacian& laplacian, const Points&) {
         const Spectrum found = spectrum(laplacian, 6, {.null_space = false});
         return heatKernelSignature(laplacian, found, heatTimes(found, 4));
       }},
      {"segments", false, [](const Laplacian& laplacian, const Points&) -> MatrixXd {
         const std::vector<int> labels = segments(laplacian, {.count = 5}).labels;
         return Eigen::Map<const Eigen::VectorXi>(labels.data(), std::ssize(labels)).cast<double>();
       }}};
}

}  // namespace tufted::support
