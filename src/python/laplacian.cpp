// Builds of L and M, and their members as arrays.
#include "tufted/laplacian.h"

#include <optional>
#include <utility>
#include <variant>

#include "python/arrays.h"
#include "python/build_options.h"
#include "python/module.h"
#include "python/running.h"
#include "tufted/components.h"
#include "tufted/describe.h"
#include "tufted/dummy_values.h"
#include "tufted/report.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

Shared buildCloud(const Doubles& points, const py::dict& given, const std::optional<Points>& normals,
                  const std::optional<Neighborhoods>& neighborhoods, const std::optional<ScanStructure>& structure,
                  const py::object& progress) {
  CloudOptions options = cloudOptionsOf(given);
  const std::optional<Eigen::Vector3d> viewpoint = viewpointOf(given);
  if (normals) options.normals = &*normals;
  if (neighborhoods) options.neighborhoods = &*neighborhoods;
  if (structure) options.structure = &*structure;
  if (viewpoint) options.viewpoint = &*viewpoint;
  const auto view = pointsOf(points);
  return run(progress, [&](const Progress& called) {
    options.progress = called;
    return std::make_shared<Laplacian>(pointCloudLaplacian(view, options));
  });
}

Shared buildMesh(const Doubles& points, const Integers& faces, const py::dict& given, const py::object& progress) {
  MeshOptions options = meshOptionsOf(given);
  const auto view = pointsOf(points);
  const auto triangles = trianglesOf(faces);
  return run(progress, [&](const Progress& called) {
    options.progress = called;
    return std::make_shared<Laplacian>(meshLaplacian(view, triangles, options));
  });
}

/// The report as a dict with a key per member.
py::dict dictOf(const Report& report) {
  py::dict dict;
  visitNumbers(report, [&](const char* name, const auto& value) { dict[name] = value; });
  dict["warnings"] = warnings(report);
  py::list stages;
  for (const StageCost& stage : report.stages)
    stages.append(
        py::dict(py::arg("name") = stage.name, py::arg("seconds") = stage.seconds, py::arg("bytes") = stage.bytes));
  dict["stages"] = stages;
  return dict;
}

/// Moves L, as the three arrays of a csc_matrix, and the N masses out of a Laplacian, which is empty afterwards.
/// @param dummy whether setDummyValues() is applied first
py::tuple takeMatrices(Laplacian& laplacian, bool dummy) {
  if (dummy) setDummyValues(laplacian.L, laplacian.M, laplacian.status);
  SparseMatrix L;
  L.swap(laplacian.L);
  VectorXd M = std::move(laplacian.M);
  laplacian = {};
  return py::make_tuple(ownedSparse(std::move(L)), std::move(M));
}

template <class T>
py::array_t<T> entriesOf(const std::vector<T>& values, const py::object& self) {
  return shown(values.data(), {std::ssize(values)}, self);
}

py::array_t<double> rowsOf(const Points& rows, const py::object& self) {
  return shown(rows.data(), {rows.rows(), 3}, self);
}

void addMembers(py::class_<Laplacian, Shared>& type) {
  const auto member = [&](const char* name, const auto& get) {
    type.def_property_readonly(name, [get](const py::object& self) { return get(self.cast<Laplacian&>(), self); });
  };
  member("L", [](const Laplacian& l, const py::object& self) { return shownSparse(l.L, self); });
  member("M", [](const Laplacian& l, const py::object& self) { return shown(l.M.data(), {l.M.size()}, self); });
  member("status", [](const Laplacian& l, const py::object& self) {
    return shown(reinterpret_cast<const std::uint8_t*>(l.status.data()), {std::ssize(l.status)}, self);
  });
  member("boundary", [](const Laplacian& l, const py::object& self) {
    return shown(reinterpret_cast<const std::uint8_t*>(l.boundary.data()), {std::ssize(l.boundary)}, self);
  });
  member("representative",
         [](const Laplacian& l, const py::object& self) { return entriesOf(l.representative, self); });
  member("normals", [](const Laplacian& l, const py::object& self) { return rowsOf(l.frames.normals, self); });
  member("tangents", [](const Laplacian& l, const py::object& self) { return rowsOf(l.frames.tangents, self); });
  member("positions", [](const Laplacian& l, const py::object& self) { return rowsOf(l.positions, self); });
  member("orientation", [](const Laplacian& l, const py::object&) { return static_cast<int>(l.frames.orientation); });
  member("component", [](const Laplacian& l, const py::object& self) {
    return l.component.empty() ? owned(componentLabels(l)) : entriesOf(l.component, self);
  });
  member("report", [](const Laplacian& l, const py::object&) { return dictOf(l.report); });
  member("is_cloud", [](const Laplacian& l, const py::object&) { return l.kind == Kind::cloud; });
  member("has_cover", [](const Laplacian& l, const py::object&) { return l.hasCover(); });
  type.def("take_matrices", &takeMatrices);
  type.def("restricted_to",
           [](const Laplacian& laplacian, const std::vector<int>& components, const py::object& progress) {
             return run(progress, [&](const Progress& called) {
               return std::make_shared<Laplacian>(restrictedTo(laplacian, components, called));
             });
           });
}

}  // namespace

void addLaplacian(py::module_& module) {
  py::class_<Laplacian, Shared> type(module, "Laplacian");
  addMembers(type);
  py::class_<ScanStructure>(module, "ScanStructure");
  module.def("build_cloud", &buildCloud);
  module.def("hovering_warning", [](const Doubles& points) {
    const Points own = pointsOf(points);
    const py::gil_scoped_release release;
    return hoveringWarning(own);
  });
  module.def("build_mesh", &buildMesh);
  module.def("image_structure", &imageStructure);
  module.def("is_depth_image", [](const Doubles& points, int width, int height, const Eigen::Vector3d& origin) {
    return isDepthImage(pointsOf(points), width, height, origin);
  });
  module.def("ring_structure", [](const Doubles& points, const Integers& rings, const Eigen::Vector3d& origin) {
    return ringStructure(pointsOf(points), indicesOf(rings), origin);
  });
  module.def("find_rings",
             [](const Doubles& points, const Eigen::Vector3d& origin) { return findRings(pointsOf(points), origin); });
}

}  // namespace tufted::python
