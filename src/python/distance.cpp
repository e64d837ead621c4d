// Geodesic distances, and lines on the surface.
#include "tufted/distance.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/arrays.h"
#include "python/module.h"
#include "python/running.h"
#include "tufted/isolines.h"
#include "tufted/path.h"
#include "tufted/tracing.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

DistanceSolver solverOf(const Laplacian& laplacian, const std::string& method, std::optional<int> split, double maximum,
                        double time_step, const std::string& unit, bool open_boundary, const Solving& solving,
                        const py::object& progress) {
  DistanceOptions options = {
      .method = chosen<DistanceMethod>("distance: method", method,
                                       {{"marching", DistanceMethod::marching}, {"heat", DistanceMethod::heat}}),
      .split = split,
      .maximum = maximum,
      .time_step = time_step,
      .unit = chosen<TimeUnit>("distance: unit", unit,
                               {{"mean", TimeUnit::mean_edge}, {"adapted", TimeUnit::adapted_edge}}),
      .open_boundary = open_boundary};
  return run(progress, [&](const Progress& called) {
    options.solver = solving.options(called);
    return DistanceSolver(laplacian, options);
  });
}

/// The sources of a query: points, then places inside triangles of a mesh.
/// @param faces, barycentric S rows: triangle and barycentric coordinates of each place
std::vector<SurfacePoint> placesOf(const Integers& sources, const Doubles& points, const Integers& triangles,
                                   const Integers& faces, const Doubles& barycentric) {
  std::vector<SurfacePoint> places;
  for (const int source : indicesOf(sources)) places.push_back(SurfacePoint::vertex(source));
  if (faces.size() > 0) {
    const Points mesh_points = pointsOf(points);
    const Triangles mesh_triangles = trianglesOf(triangles);
    for (py::ssize_t k = 0; k < faces.size(); ++k)
      places.push_back(SurfacePoint::inFace(mesh_points, mesh_triangles, faces.at(k),
                                            {barycentric.at(k, 0), barycentric.at(k, 1), barycentric.at(k, 2)}));
  }
  return places;
}

VectorXd query(const DistanceSolver& solver, const std::vector<SurfacePoint>& places, const py::object& progress) {
  return run(progress, [&](const Progress& called) { return solver.queryAt(places, nullptr, called); });
}

/// N distances, and N indices into `places` of the nearest source, -1 where no path leads.
py::tuple nearest(const DistanceSolver& solver, const std::vector<SurfacePoint>& places, const py::object& progress) {
  NearestSources found = run(progress, [&](const Progress& called) { return solver.nearest(places, nullptr, called); });
  return py::make_tuple(std::move(found.distance), owned(std::move(found.source)));
}

/// N x S distances from each source.
Eigen::MatrixXd matrix(const DistanceSolver& solver, const std::vector<SurfacePoint>& places, bool symmetric,
                       const py::object& progress) {
  return run(progress, [&](const Progress& called) { return solver.matrix(places, symmetric, nullptr, called); });
}

/// The points within a radius of some points, ascending, and their distances.
py::tuple within(const Laplacian& laplacian, const Integers& sources, double radius, std::optional<int> split,
                 const py::object& progress) {
  const std::vector<int> places = indicesOf(sources);
  NearbyPoints found =
      run(progress, [&](const Progress& called) { return pointsWithin(laplacian, places, radius, split, called); });
  return py::make_tuple(owned(std::move(found.points)), owned(std::move(found.distances)));
}

PathSolver pathSolverOf(const Laplacian& laplacian, const Solving& solving, const py::object& progress) {
  return run(progress, [&](const Progress& called) {
    return PathSolver(laplacian, {solving.options(called).threads, called});
  });
}

/// The points of a path, K x 3, and its length.
py::tuple pathBetween(const PathSolver& solver, int from, int to, const py::object& progress) {
  SurfacePath path = run(progress, [&](const Progress& called) { return solver.query(from, to, called); });
  return py::make_tuple(std::move(path.points), path.length);
}

/// The points of a straightened way, K x 3, and its length.
py::tuple pathThrough(const PathSolver& solver, const Integers& points, bool is_closed, const py::object& progress) {
  const std::vector<int> stops = indicesOf(points);
  SurfacePath path = run(progress, [&](const Progress& called) { return solver.through(stops, is_closed, called); });
  return py::make_tuple(std::move(path.points), path.length);
}

GeodesicTracer tracerOf(const Doubles& points, const Integers& faces, Points normals, Points tangents) {
  return {pointsOf(points), trianglesOf(faces), {std::move(normals), std::move(tangents), Orientation::arbitrary}};
}

/// Points, length, why the line ends, direction there, and corners and barycentric coordinates of the end.
py::tuple traced(const GeodesicTracer& tracer, const SurfacePoint& start, const Eigen::RowVector3d& direction,
                 double length, const py::object& progress) {
  TracedLine found =
      run(progress, [&](const Progress& called) { return tracer.query(start, direction, length, called); });
  return py::make_tuple(std::move(found.line.points), found.line.length, nameOf(found.reason), found.direction,
                        found.end.corners, found.end.weights);
}

/// A list with a tuple for each line: its points, value and length, and whether it is closed.
py::list isolinesOf(const Doubles& points, const Integers& faces, const VectorXd& field,
                    const std::vector<double>& values, const py::object& progress) {
  std::vector<Polyline> lines = run(progress, [&](const Progress& called) {
    return isolines(pointsOf(points), trianglesOf(faces), field, values, called);
  });
  py::list result;
  for (Polyline& line : lines)
    result.append(py::make_tuple(std::move(line.points), line.value, line.length, line.is_closed));
  return result;
}

}  // namespace

void addDistance(py::module_& module) {
  py::class_<SurfacePoint>(module, "SurfacePoint");  // NOLINT(bugprone-unused-raii): registers it
  module.def("surface_points", &placesOf);
  module.def("points_within", &within);
  py::class_<DistanceSolver>(module, "DistanceSolver")
      .def(py::init(&solverOf))
      .def("query", &query)
      .def("nearest", &nearest)
      .def("matrix", &matrix)
      .def_property_readonly("time_step", &DistanceSolver::timeStep);
  py::class_<PathSolver>(module, "PathSolver")
      .def(py::init(&pathSolverOf))
      .def("path", &pathBetween)
      .def("through", &pathThrough);
  py::class_<GeodesicTracer>(module, "GeodesicTracer").def(py::init(&tracerOf)).def("query", &traced);
  module.def("isolines", &isolinesOf);
}

}  // namespace tufted::python
