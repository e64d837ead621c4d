// Pages that show points with values.
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "python/arrays.h"
#include "python/module.h"
#include "tufted/view/page.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

/// Members of a SceneField: name, kind, values, unit, label_names and no_value.
using FieldTuple =
    std::tuple<std::string, std::string, Eigen::MatrixXd, std::string, std::vector<std::string>, std::string>;

std::string page(std::string title, const Doubles& points, const Integers& faces, Points normals,
                 const std::vector<FieldTuple>& fields) {
  const std::map<std::string, FieldKind> kinds = {
      {"scalar", FieldKind::scalar}, {"diverging", FieldKind::diverging}, {"distance", FieldKind::distance},
      {"label", FieldKind::label},   {"vector", FieldKind::vector},       {"coordinates", FieldKind::coordinates},
      {"color", FieldKind::color},   {"positive", FieldKind::positive},   {"direction", FieldKind::direction}};
  Scene scene = {.title = std::move(title),
                 .positions = pointsOf(points),
                 .triangles = trianglesOf(faces),
                 .normals = std::move(normals)};
  for (const auto& [name, kind, values, unit, label_names, no_value] : fields)
    scene.fields.push_back({name, chosen<FieldKind>("page: kind", kind, kinds), values, unit, label_names, no_value});
  const py::gil_scoped_release release;
  return pageOf(scene);
}

}  // namespace

void addView(py::module_& module) {
  module.def("page", &page);
}

}  // namespace tufted::python
