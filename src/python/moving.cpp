// New positions of the points: parameterisation, minimal surfaces, deformation, smoothing, denoising.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/arrays.h"
#include "python/module.h"
#include "python/running.h"
#include "tufted/deformation.h"
#include "tufted/denoise.h"
#include "tufted/mean_curvature_flow.h"
#include "tufted/minimal_surface.h"
#include "tufted/parameterization.h"
#include "tufted/smoothing.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

using Marks = py::array_t<std::uint8_t, py::array::c_style>;

std::optional<std::vector<std::uint8_t>> marksOf(const std::optional<Marks>& marks) {
  if (!marks) return std::nullopt;
  return std::vector<std::uint8_t>(marks->data(), marks->data() + marks->size());
}

SmoothingSolver smoothingSolver(const Laplacian& laplacian, double time_step, const std::optional<Marks>& fixed,
                                const Solving& solving, const py::object& progress) {
  const auto stays = marksOf(fixed);
  return run(progress, [&](const Progress& called) {
    return SmoothingSolver(
        laplacian, {.time_step = time_step, .fixed = stays ? &*stays : nullptr, .solver = solving.options(called)});
  });
}

/// Options of smooth() and smooth_values(), with the arrays that they borrow.
struct Smoothing {
  SmoothingOptions options;
  std::optional<std::vector<std::uint8_t>> fixed;
  std::optional<Triangles> volume_of;

  Smoothing(const std::string& function, const std::string& method, double time_step, double lambda, double mu,
            int iterations, const std::optional<Marks>& marks, const std::optional<Integers>& faces, int threads)
      : fixed(marksOf(marks)) {
    options.method =
        chosen<SmoothingMethod>((function + ": method").c_str(), method,
                                {{"implicit", SmoothingMethod::implicit}, {"taubin", SmoothingMethod::taubin}});
    options.time_step = time_step;
    options.lambda = lambda;
    options.mu = mu;
    options.iterations = iterations;
    options.solver.threads = threads;
    if (faces) volume_of = trianglesOf(*faces);
  }

  SmoothingOptions with(const Progress& progress) const {
    SmoothingOptions all = options;
    all.fixed = fixed ? &*fixed : nullptr;
    all.volume_of = volume_of ? &*volume_of : nullptr;
    all.solver.progress = progress;
    return all;
  }
};

Points smoothed(const Laplacian& laplacian, const Doubles& points, const std::string& method, double time_step,
                double lambda, double mu, int iterations, const std::optional<Marks>& fixed,
                const std::optional<Integers>& faces, int threads, const py::object& progress) {
  const Smoothing how("smooth", method, time_step, lambda, mu, iterations, fixed, faces, threads);
  const auto view = pointsOf(points);
  return run(progress, [&](const Progress& called) { return smooth(laplacian, view, how.with(called)); });
}

Eigen::MatrixXd smoothedValues(const Laplacian& laplacian, const Eigen::MatrixXd& values, const std::string& method,
                               double time_step, double lambda, double mu, int iterations,
                               const std::optional<Marks>& fixed, int threads, const py::object& progress) {
  const Smoothing how("smooth_values", method, time_step, lambda, mu, iterations, fixed, std::nullopt, threads);
  return run(progress, [&](const Progress& called) { return smoothValues(laplacian, values, how.with(called)); });
}

py::tuple denoised(const Doubles& points, const std::optional<ScanStructure>& structure, int threads,
                   const py::object& progress) {
  const auto view = pointsOf(points);
  DenoisedPoints done = run(progress, [&](const Progress& called) {
    return denoise(view, {.structure = structure ? &*structure : nullptr, .threads = threads, .progress = called});
  });
  const DenoiseReport& report = done.report;
  return py::make_tuple(std::move(done.positions), std::move(done.noise), report.moved, report.outliers, report.noise,
                        warnings(report));
}

py::tuple parameterized(const Laplacian& laplacian, const Integers& faces, const std::string& method,
                        const std::string& weights, const Integers& rim, const Eigen::MatrixXd& rim_positions,
                        const std::optional<std::vector<std::vector<int>>>& cuts, const Solving& solving,
                        const py::object& progress) {
  const auto triangles = trianglesOf(faces);
  ParameterizationOptions options = {
      .method = chosen<ParameterizationMethod>(
          "parameterize: method", method,
          {{"conformal", ParameterizationMethod::conformal}, {"harmonic", ParameterizationMethod::harmonic}}),
      .weights = chosen<HarmonicWeights>(
          "parameterize: weights", weights,
          {{"laplacian", HarmonicWeights::laplacian}, {"mean-value", HarmonicWeights::mean_value}}),
      .rim = indicesOf(rim)};
  options.rim_positions = rim_positions;
  ParameterizationReport report;
  Eigen::MatrixXd uv = run(progress, [&](const Progress& called) {
    options.solver = solving.options(called);
    return Eigen::MatrixXd(cuts ? parameterizeCut(laplacian, triangles, *cuts, options, &report)
                                : parameterize(laplacian, triangles, options, &report));
  });
  return py::make_tuple(std::move(uv), report.quasi_conformal_error, report.triangles, report.flipped, report.collapsed,
                        report.not_mapped);
}

py::tuple minimal(const Laplacian& laplacian, const Integers& faces, const Integers& fixed, double tolerance,
                  int max_iterations, const Solving& solving, const py::object& progress) {
  const auto triangles = trianglesOf(faces);
  MinimalSurfaceOptions options = {.fixed = indicesOf(fixed), .tolerance = tolerance, .max_iterations = max_iterations};
  MinimalSurfaceReport report;
  Points found = run(progress, [&](const Progress& called) {
    options.solver = solving.options(called);
    return minimalSurface(laplacian, triangles, options, &report);
  });
  return py::make_tuple(std::move(found), report.area, report.converged);
}

Points flowed(const Laplacian& laplacian, const Integers& faces, double time_step, int steps, const Solving& solving,
              const py::object& progress) {
  const auto triangles = trianglesOf(faces);
  return run(progress, [&](const Progress& called) {
    return meanCurvatureFlow(laplacian, triangles,
                             {.time_step = time_step, .steps = steps, .solver = solving.options(called)});
  });
}

DeformationSolver deformationSolver(const Laplacian& laplacian, const Integers& handles, const std::string& method,
                                    double smoothness, double tolerance, int max_iterations, const Solving& solving,
                                    const py::object& progress) {
  DeformationOptions options = {.method = chosen<DeformationMethod>("deform: method", method,
                                                                    {{"rigid", DeformationMethod::as_rigid_as_possible},
                                                                     {"linear", DeformationMethod::linear}}),
                                .smoothness = smoothness,
                                .tolerance = tolerance,
                                .max_iterations = max_iterations};
  std::vector<int> points = indicesOf(handles);
  return run(progress, [&](const Progress& called) {
    options.solver = solving.options(called);
    return DeformationSolver(laplacian, std::move(points), options);
  });
}

}  // namespace

void addMoving(py::module_& module) {
  module.def("smooth", &smoothed);
  module.def("smooth_values", &smoothedValues);
  module.def("denoise", &denoised);
  module.def("parameterize", &parameterized);
  module.def("minimal_surface", &minimal);
  module.def("mean_curvature_flow", &flowed);
  py::class_<SmoothingSolver>(module, "SmoothingSolver")
      .def(py::init(&smoothingSolver))
      .def("smooth",
           [](const SmoothingSolver& solver, const Doubles& points, int iterations, const py::object& progress) {
             const auto view = pointsOf(points);
             return run(progress, [&](const Progress& called) { return solver.query(view, iterations, called); });
           });
  py::class_<DeformationSolver>(module, "DeformationSolver")
      .def(py::init(&deformationSolver))
      .def("deform", [](const DeformationSolver& solver, const Doubles& targets, const py::object& progress) {
        const auto view = pointsOf(targets);
        DeformationReport report;
        Points moved = run(progress, [&](const Progress& called) { return solver.query(view, &report, called); });
        return py::make_tuple(std::move(moved), report.stretch, report.converged);
      });
}

}  // namespace tufted::python
