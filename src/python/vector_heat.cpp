// Values and vectors carried along the surface, and the logarithmic map.
#include "tufted/vector_heat.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/arrays.h"
#include "python/module.h"
#include "python/running.h"
#include "tufted/signed_distance.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

/// Calls make(VectorHeatOptions) without holding Python's lock.
/// @return what it returns
template <class Make>
auto madeWith(double time_step, const Solving& solving, const py::object& progress, const Make& make) {
  return run(progress, [&](const Progress& called) {
    return make(VectorHeatOptions{.time_step = time_step, .solver = solving.options(called)});
  });
}

Frames framesFrom(Points normals, Points tangents) {
  return {std::move(normals), std::move(tangents), Orientation::arbitrary};
}

template <class Solver>
auto withFrames() {
  return py::init([](const Laplacian& laplacian, Points normals, Points tangents, double time_step,
                     const Solving& solving, const py::object& progress) {
    const Frames frames = framesFrom(std::move(normals), std::move(tangents));
    return madeWith(time_step, solving, progress,
                    [&](const VectorHeatOptions& options) { return Solver(laplacian, frames, options); });
  });
}

SignedDistanceSolver signedSolverOf(const Laplacian& laplacian, Points normals, Points tangents,
                                    const std::string& method, std::optional<int> split, double time_step,
                                    const Solving& solving, const py::object& progress) {
  const Frames frames = framesFrom(std::move(normals), std::move(tangents));
  SignedDistanceOptions options = {
      .method = chosen<DistanceMethod>("signed_distance: method", method,
                                       {{"marching", DistanceMethod::marching}, {"heat", DistanceMethod::heat}}),
      .split = split,
      .time_step = time_step};
  return run(progress, [&](const Progress& called) {
    options.solver = solving.options(called);
    return SignedDistanceSolver(laplacian, frames, options);
  });
}

LogMapSolver logMapSolverOf(const Laplacian& laplacian, Points normals, Points tangents, const std::string& method,
                            double time_step, const Solving& solving, const py::object& progress) {
  const Frames frames = framesFrom(std::move(normals), std::move(tangents));
  LogMapOptions options = {
      .method = chosen<LogMapMethod>("log_map: method", method,
                                     {{"exact", LogMapMethod::exact}, {"heat", LogMapMethod::heat}}),
      .time_step = time_step};
  return run(progress, [&](const Progress& called) {
    options.solver = solving.options(called);
    return LogMapSolver(laplacian, frames, options);
  });
}

}  // namespace

void addVectorHeat(py::module_& module) {
  py::class_<ExtensionSolver>(module, "ExtensionSolver")
      .def(py::init(
          [](const Laplacian& laplacian, double time_step, const Solving& solving, const py::object& progress) {
            return madeWith(time_step, solving, progress,
                            [&](const VectorHeatOptions& options) { return ExtensionSolver(laplacian, options); });
          }))
      .def("query", [](const ExtensionSolver& solver, const Integers& sources, const Eigen::MatrixXd& values,
                       const py::object& progress) {
        const std::vector<int> indices = indicesOf(sources);
        return run(progress, [&](const Progress& called) { return solver.query(indices, values, nullptr, called); });
      });
  py::class_<TransportSolver>(module, "TransportSolver")
      .def(withFrames<TransportSolver>())
      .def("query", [](const TransportSolver& solver, const Integers& sources, const Points& vectors,
                       const py::object& progress) {
        const std::vector<int> indices = indicesOf(sources);
        return run(progress, [&](const Progress& called) { return solver.query(indices, vectors, nullptr, called); });
      });
  py::class_<LogMapSolver>(module, "LogMapSolver")
      .def(py::init(&logMapSolverOf))
      .def("query",
           [](const LogMapSolver& solver, int source, const Eigen::RowVector3d& axis, const py::object& progress) {
             LogMap map = run(progress, [&](const Progress& called) { return solver.query(source, axis, called); });
             return py::make_tuple(std::move(map.coordinates), map.first, map.second);
           });
  py::class_<SignedDistanceSolver>(module, "SignedDistanceSolver")
      .def(py::init(&signedSolverOf))
      .def("query", [](const SignedDistanceSolver& solver, const std::vector<SurfaceCurve>& curves,
                       const std::vector<SurfacePoint>& points, const py::object& progress) {
        SignedDistanceReport report;
        VectorXd values =
            run(progress, [&](const Progress& called) { return solver.queryAt(curves, points, &report, called); });
        return py::make_tuple(std::move(values), longSegmentsWarning(report));
      });
}

}  // namespace tufted::python
