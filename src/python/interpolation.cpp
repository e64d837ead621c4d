// Interpolation of given values, and equations with L.
#include "tufted/interpolation.h"

#include <string>
#include <utility>
#include <vector>

#include "python/arrays.h"
#include "python/module.h"
#include "python/running.h"
#include "tufted/weights.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

InterpolationSolver interpolationSolver(const Laplacian& laplacian, const Integers& points, const std::string& kind,
                                        const Solving& solving, const py::object& progress) {
  const auto chosen_kind = chosen<Interpolation>(
      "harmonic: kind", kind, {{"harmonic", Interpolation::harmonic}, {"biharmonic", Interpolation::biharmonic}});
  std::vector<int> pins = indicesOf(points);
  return run(progress, [&](const Progress& called) {
    return InterpolationSolver(laplacian, std::move(pins), chosen_kind, solving.options(called));
  });
}

}  // namespace

void addInterpolation(py::module_& module) {
  module.def("weights", [](const Laplacian& laplacian, const std::vector<std::vector<int>>& handles,
                           const Solving& solving, const py::object& progress) {
    return run(progress, [&](const Progress& called) {
      return boundedBiharmonicWeights(laplacian, handles, {.solver = solving.options(called)});
    });
  });
  py::class_<InterpolationSolver>(module, "InterpolationSolver")
      .def(py::init(&interpolationSolver))
      .def("interpolate",
           [](const InterpolationSolver& solver, const Eigen::MatrixXd& values, const py::object& progress) {
             return run(progress, [&](const Progress& called) { return solver.query(values, nullptr, called); });
           })
      .def("poisson", [](const InterpolationSolver& solver, const Eigen::MatrixXd& f, const Eigen::MatrixXd& values,
                         const py::object& progress) {
        return run(progress, [&](const Progress& called) { return solver.queryPoisson(f, values, nullptr, called); });
      });
  py::class_<PoissonSolver>(module, "PoissonSolver")
      .def(py::init([](const Laplacian& laplacian, const Solving& solving, const py::object& progress) {
        return run(progress, [&](const Progress& called) { return PoissonSolver(laplacian, solving.options(called)); });
      }))
      .def("poisson",
           [](const PoissonSolver& solver, const Eigen::MatrixXd& f, const py::object& progress) {
             return run(progress, [&](const Progress& called) { return solver.query(f, nullptr, called); });
           })
      .def("green", [](const PoissonSolver& solver, const Integers& points, const py::object& progress) {
        const std::vector<int> indices = indicesOf(points);
        return run(progress, [&](const Progress& called) { return solver.queryGreen(indices, nullptr, called); });
      });
}

}  // namespace tufted::python
