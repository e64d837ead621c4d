// Converts a Laplacian to a dict of arrays and back, for pickle. The dict includes the cover, which could not be built
// later because the stars are not stored.
#include <cstring>
#include <utility>

#include "python/arrays.h"
#include "python/module.h"
#include "tufted/check.h"
#include "tufted/report.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

using Bytes = py::array_t<std::uint8_t, py::array::c_style>;

template <class Value>
py::array_t<std::uint8_t> bytesOf(const std::vector<Value>& values, const py::object& self) {
  static_assert(sizeof(Value) == 1);
  return shown(reinterpret_cast<const std::uint8_t*>(values.data()), {std::ssize(values)}, self);
}

template <class Value>
std::vector<Value> enumsOf(const py::handle& bytes) {
  const auto array = bytes.cast<Bytes>();
  std::vector<Value> values(static_cast<std::size_t>(array.size()));
  if (!values.empty()) std::memcpy(values.data(), array.data(), values.size());
  return values;
}

template <class T>
std::vector<T> vectorOf(const py::handle& object) {
  const auto array = object.cast<py::array_t<T, py::array::c_style>>();
  return {array.data(), array.data() + array.size()};
}

py::object coverOf(const Laplacian& laplacian) {
  if (!laplacian.hasCover()) return py::none();
  const IntrinsicTriangulation& cover = [&]() -> const IntrinsicTriangulation& {
    const py::gil_scoped_release release;
    return laplacian.cover();
  }();
  std::vector<int> corners;
  corners.reserve(3 * cover.faces.size());
  for (const auto& face : cover.faces) corners.insert(corners.end(), face.begin(), face.end());
  return py::make_tuple(cover.vertices, owned(std::move(corners)), owned(cover.glue), owned(cover.length));
}

IntrinsicTriangulation coverFrom(const py::handle& object) {
  const auto parts = object.cast<py::tuple>();
  IntrinsicTriangulation cover;
  cover.vertices = parts[0].cast<int>();
  const auto corners = vectorOf<int>(parts[1]);
  cover.faces.resize(corners.size() / 3);
  for (std::size_t f = 0; f < cover.faces.size(); ++f)
    cover.faces[f] = {corners[3 * f], corners[3 * f + 1], corners[3 * f + 2]};
  cover.glue = vectorOf<int>(parts[2]);
  cover.length = vectorOf<double>(parts[3]);
  return cover;
}

py::dict numbersOf(const Report& report) {
  py::dict numbers;
  visitNumbers(report, [&](const char* name, const auto& value) { numbers[name] = value; });
  py::list stages;
  for (const StageCost& stage : report.stages) stages.append(py::make_tuple(stage.name, stage.seconds, stage.bytes));
  numbers["stages"] = stages;
  return numbers;
}

Report reportFrom(const py::dict& numbers) {
  Report report;
  visitNumbers(report, [&](const char* name, auto& value) {
    value = numbers[name].template cast<std::decay_t<decltype(value)>>();
  });
  for (const py::handle& stage : numbers["stages"]) {
    const auto parts = stage.cast<py::tuple>();
    report.stages.push_back({parts[0].cast<std::string>(), parts[1].cast<double>(), parts[2].cast<std::size_t>()});
  }
  return report;
}

py::dict stateOf(const py::object& self) {
  const auto& laplacian = self.cast<const Laplacian&>();
  py::dict state;
  state["is_cloud"] = laplacian.kind == Kind::cloud;
  state["L"] = shownSparse(laplacian.L, self);
  state["M"] = laplacian.M;
  state["cover_areas"] = laplacian.cover_areas;
  state["status"] = bytesOf(laplacian.status, self);
  state["representative"] = owned(laplacian.representative);
  state["boundary"] = bytesOf(laplacian.boundary, self);
  state["component"] = owned(laplacian.component);
  state["normals"] = laplacian.frames.normals;
  state["tangents"] = laplacian.frames.tangents;
  state["orientation"] = static_cast<int>(laplacian.frames.orientation);
  state["positions"] = laplacian.positions;
  state["noise"] = laplacian.noise;
  py::list edges;
  for (const auto& [sides, mean, mean_square] : laplacian.component_edges)
    edges.append(py::make_tuple(sides, mean, mean_square));
  state["component_edges"] = edges;
  state["cover"] = coverOf(laplacian);
  state["report"] = numbersOf(laplacian.report);
  return state;
}

SparseMatrix sparseFrom(const py::handle& object, Eigen::Index n) {
  const auto parts = object.cast<py::tuple>();
  const auto values = parts[0].cast<Doubles>();
  const auto rows = parts[1].cast<Integers>(), starts = parts[2].cast<Integers>();
  return Eigen::Map<const SparseMatrix>(n, n, values.size(), starts.data(), rows.data(), values.data());
}

Shared fromState(const py::dict& state) {
  auto laplacian = std::make_shared<Laplacian>();
  laplacian->kind = state["is_cloud"].cast<bool>() ? Kind::cloud : Kind::mesh;
  laplacian->status = enumsOf<PointStatus>(state["status"]);
  laplacian->L = sparseFrom(state["L"], std::ssize(laplacian->status));
  laplacian->M = state["M"].cast<VectorXd>();
  laplacian->cover_areas = state["cover_areas"].cast<VectorXd>();
  laplacian->representative = vectorOf<int>(state["representative"]);
  laplacian->boundary = enumsOf<Boundary>(state["boundary"]);
  laplacian->component = vectorOf<int>(state["component"]);
  laplacian->frames = {state["normals"].cast<Points>(), state["tangents"].cast<Points>(),
                       static_cast<Orientation>(state["orientation"].cast<int>())};
  laplacian->positions = state["positions"].cast<Points>();
  laplacian->noise = state["noise"].cast<VectorXd>();
  for (const py::handle& edges : state["component_edges"]) {
    const auto parts = edges.cast<py::tuple>();
    laplacian->component_edges.push_back(
        {parts[0].cast<std::int64_t>(), parts[1].cast<double>(), parts[2].cast<double>()});
  }
  if (!state["cover"].is_none()) laplacian->setCover(coverFrom(state["cover"]));
  laplacian->report = reportFrom(state["report"]);
  checkSizes("pickle", *laplacian);
  return laplacian;
}

}  // namespace

void addPickling(py::module_& module) {
  module.def("state_of", &stateOf);
  module.def("from_state", &fromState);
}

}  // namespace tufted::python
