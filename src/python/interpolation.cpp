// Interpolation of given values, and equations with L.
#include "tufted/interpolation.h"

#include <utility>

#include "python/arrays.h"
#include "python/module.h"
#include "python/running.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

using Interpolate = Eigen::MatrixXd (*)(const Laplacian&, const Pins&, const SolverOptions&, SolveReport*);

template <Interpolate interpolate>
Eigen::MatrixXd interpolated(const Laplacian& laplacian, const Integers& points, Eigen::MatrixXd values,
                             const Solving& solving, const py::object& progress) {
  const Pins pins = {indicesOf(points), std::move(values)};
  return run(progress,
             [&](const Progress& called) { return interpolate(laplacian, pins, solving.options(called), nullptr); });
}

}  // namespace

void addInterpolation(py::module_& module) {
  module.def("harmonic", &interpolated<&harmonic>);
  module.def("biharmonic", &interpolated<&biharmonic>);
  module.def("pinned_poisson", [](const Laplacian& laplacian, const Eigen::MatrixXd& f, const Integers& points,
                                  Eigen::MatrixXd values, const Solving& solving, const py::object& progress) {
    const Pins pins = {indicesOf(points), std::move(values)};
    return run(progress, [&](const Progress& called) { return poisson(laplacian, f, pins, solving.options(called)); });
  });
  py::class_<PoissonSolver>(module, "PoissonSolver")
      .def(py::init([](const Shared& laplacian, const Solving& solving, const py::object& progress) {
        return run(progress, [&](const Progress& called) { return PoissonSolver(laplacian, solving.options(called)); });
      }))
      .def("poisson",
           [](const PoissonSolver& solver, const Eigen::MatrixXd& f, const py::object& progress) {
             return run(progress, [&](const Progress& called) { return solver.poisson(f, nullptr, called); });
           })
      .def("green", [](const PoissonSolver& solver, const Integers& points, const py::object& progress) {
        const std::vector<int> indices = indicesOf(points);
        return run(progress, [&](const Progress& called) { return solver.green(indices, nullptr, called); });
      });
}

}  // namespace tufted::python
