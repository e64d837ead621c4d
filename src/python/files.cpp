// Reading and writing files.
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "python/arrays.h"
#include "python/build_options.h"
#include "python/module.h"
#include "python/running.h"
#include "tufted/io/read.h"
#include "tufted/io/results.h"
#include "tufted/io/select.h"
#include "tufted/io/write.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

const std::map<std::string, Format> formats = {{"npz", Format::npz},     {"mtx", Format::mtx},
                                               {"mat", Format::mat},     {"spmat", Format::spmat},
                                               {"petsc", Format::petsc}, {"ply", Format::ply},
                                               {"pcd", Format::pcd},     {"las", Format::las},
                                               {"cover", Format::cover}, {"triangles", Format::triangles}};

const char* typeOf(FieldType type) {
  constexpr const char* names[] = {"i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"};
  return names[static_cast<int>(type)];
}

/// The fields of a file by name, N values each, or N x count.
py::dict fieldsOf(const Geometry& geometry) {
  py::dict fields;
  for (const Field& field : geometry.fields) {
    Shape shape = {geometry.points.rows()};
    if (field.count != 1) shape.push_back(field.count);
    fields[py::str(field.name)] = py::array(py::dtype(typeOf(field.type)), shape, field.bytes.data());
  }
  return fields;
}

/// @param crop the six numbers of the lower and the upper corner, or none
Selection selectionOf(const std::vector<std::string>& where, const std::vector<double>& crop,
                      const std::vector<Eigen::Vector2d>& polygon, double thin) {
  Selection selection = {.where = where, .polygon = polygon, .thin = thin};
  if (!crop.empty()) selection.crop.emplace(Eigen::Vector3d(crop.data()), Eigen::Vector3d(crop.data() + 3));
  return selection;
}

Geometry readFile(const std::filesystem::path& path, const std::string& kind, bool weld, const py::object& progress,
                  const Selection& selection) {
  const auto as = chosen<ReadAs>("read: kind", kind,
                                 {{"automatic", ReadAs::automatic}, {"cloud", ReadAs::cloud}, {"mesh", ReadAs::mesh}});
  Geometry geometry =
      run(progress, [&](const Progress& called) { return read(path, as, FileFormat::automatic, called); });
  if (weld && !geometry.is_mesh)
    throw InvalidInput("read: weld = True, must be False for a cloud, whose coincident points are merged in any case");
  if (selection.isEmpty())
    removeFileRow(geometry);
  else
    run(progress, [&](const Progress& called) { return select(geometry, selection, called); });
  const int caller = 3;  // stack level: the line that called the function of the package, which is wrapped once
  for (const std::string& note : geometry.notes)
    if (PyErr_WarnEx(PyExc_UserWarning, note.c_str(), caller) != 0) throw py::error_already_set();
  return geometry;
}

/// The members of a Geometry except `unread_bytes`, for pickle and copies.
py::tuple geometryState(const Geometry& geometry) {
  py::list fields;
  for (const Field& field : geometry.fields)
    fields.append(py::make_tuple(field.name, static_cast<int>(field.type), field.count,
                                 py::array_t<std::uint8_t>(static_cast<py::ssize_t>(field.bytes.size()),
                                                           reinterpret_cast<const std::uint8_t*>(field.bytes.data()))));
  return py::make_tuple(geometry.format, geometry.points, geometry.normals, fields, geometry.width, geometry.height,
                        geometry.viewpoint, geometry.is_mesh, geometry.triangles, geometry.polygons,
                        geometry.merged_vertices, geometry.notes, py::bytes(geometry.las_header));
}

Geometry geometryFrom(const py::tuple& state) {
  Geometry geometry;
  geometry.format = state[0].cast<std::string>();
  geometry.points = state[1].cast<Points>();
  geometry.normals = state[2].cast<Points>();
  for (const py::handle& each : state[3]) {
    const auto parts = each.cast<py::tuple>();
    const auto bytes = parts[3].cast<py::array_t<std::uint8_t, py::array::c_style>>();
    const auto* const first = reinterpret_cast<const std::byte*>(bytes.data());
    geometry.fields.push_back({parts[0].cast<std::string>(),
                               static_cast<FieldType>(parts[1].cast<int>()),
                               parts[2].cast<int>(),
                               {first, first + bytes.size()}});
  }
  geometry.width = state[4].cast<int>();
  geometry.height = state[5].cast<int>();
  geometry.viewpoint = state[6].cast<decltype(geometry.viewpoint)>();
  geometry.is_mesh = state[7].cast<bool>();
  geometry.triangles = state[8].cast<Triangles>();
  geometry.polygons = state[9].cast<std::int64_t>();
  geometry.merged_vertices = state[10].cast<std::int64_t>();
  geometry.notes = state[11].cast<std::vector<std::string>>();
  geometry.las_header = state[12].cast<std::string>();
  return geometry;
}

/// The Geometry that save() writes if the points were not read from a file.
/// @param faces F x 3; none for a cloud
Geometry geometryOf(const Doubles& points, const std::optional<Integers>& faces) {
  Geometry geometry;
  geometry.points = pointsOf(points);
  geometry.width = static_cast<int>(geometry.points.rows());
  geometry.is_mesh = faces.has_value();
  if (faces) geometry.triangles = trianglesOf(*faces);
  return geometry;
}

/// Sets the options of a build that WriteOptions records in report.json, and owns what they borrow.
class RecordedOptions {
 public:
  /// @param options_given a dict of the options, the JSON text of an earlier report, or None to record nothing
  RecordedOptions(const Laplacian& laplacian, const py::object& options_given, WriteOptions& options) {
    if (options_given.is_none()) return;
    if (py::isinstance<py::str>(options_given)) {
      options.build_options = options_given.cast<std::string>();
      return;
    }
    const auto given = options_given.cast<py::dict>();
    if (laplacian.kind == Kind::mesh) {
      mesh_ = meshOptionsOf(given);
      options.mesh = &mesh_;
      return;
    }
    const auto structure = given["structure"].cast<std::string>();
    cloud_ = cloudOptionsOf(given);
    viewpoint_ = viewpointOf(given);
    structure_.has_rings = structure == "rings";
    if (structure != "none") cloud_.structure = &structure_;
    if (given["given_normals"].cast<bool>()) cloud_.normals = &normals_;
    if (given["given_neighborhoods"].cast<bool>()) cloud_.neighborhoods = &neighborhoods_;
    if (viewpoint_) cloud_.viewpoint = &*viewpoint_;
    options.cloud = &cloud_;
  }
  RecordedOptions(const RecordedOptions&) = delete;
  RecordedOptions& operator=(const RecordedOptions&) = delete;

 private:
  CloudOptions cloud_;
  MeshOptions mesh_;
  // Empty: report.json records only whether normals, neighbourhoods and a structure were given.
  Points normals_;
  Neighborhoods neighborhoods_;
  ScanStructure structure_;
  std::optional<Eigen::Vector3d> viewpoint_;
};

void saveTo(const std::filesystem::path& dir, const Laplacian& laplacian, const Geometry& geometry,
            const std::vector<std::string>& names, const std::string& source, const std::string& sign, bool dummy,
            const py::object& given, const py::object& progress) {
  WriteOptions options = {.formats = {},
                          .sign = chosen<Sign>("save: sign", sign, {{"psd", Sign::psd}, {"igl", Sign::igl}}),
                          .dummy = dummy,
                          .source = source};
  for (const std::string& name : names) options.formats.push_back(chosen<Format>("save: formats", name, formats));
  const RecordedOptions recorded(laplacian, given, options);
  run(progress, [&](const Progress& called) {
    options.progress = called;
    writeLaplacian(dir, laplacian, geometry, options);
  });
}

}  // namespace

void addFiles(py::module_& module) {
  py::class_<Geometry>(module, "Geometry")
      .def(py::init(&geometryOf))
      .def_readonly("points", &Geometry::points)
      .def_readonly("normals", &Geometry::normals)
      .def_readonly("triangles", &Geometry::triangles)
      .def_readonly("is_mesh", &Geometry::is_mesh)
      .def_readonly("width", &Geometry::width)
      .def_readonly("height", &Geometry::height)
      .def_readonly("viewpoint", &Geometry::viewpoint)
      .def_readonly("format", &Geometry::format)
      .def_readonly("notes", &Geometry::notes)
      .def_property_readonly("fields", &fieldsOf)
      .def(py::pickle(&geometryState, &geometryFrom));
  py::class_<Selection>(module, "Selection").def(py::init(&selectionOf));
  module.def("read_file", &readFile, py::arg("path"), py::arg("kind"), py::arg("weld"), py::arg("progress"),
             py::arg("selection") = Selection());
  module.def("thin", [](const Doubles& points, double spacing) {
    const auto given = pointsOf(points);
    return owned(run(py::none(), [&](const Progress& called) { return thinPoints(given, spacing, called); }));
  });
  module.def("rings_of", &ringsOf);
  module.def("save", &saveTo);
  module.def("load", [](const std::filesystem::path& dir, bool with_cover) {
    const py::gil_scoped_release release;
    return std::make_shared<Laplacian>(readLaplacian(dir, with_cover));
  });
  module.def("files_of_result", &filesOfResult);
  module.def("read_points", [](const std::filesystem::path& dir, const py::object& progress) {
    return run(progress, [&](const Progress& called) { return readPoints(dir, called); });
  });
}

}  // namespace tufted::python
