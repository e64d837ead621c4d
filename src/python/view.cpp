// Pages and pictures that show points with values.
#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "python/arrays.h"
#include "python/module.h"
#include "python/running.h"
#include "tufted/view/page.h"
#include "tufted/view/picture.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

/// Members of a SceneField: name, kind, values, unit, label_names and no_value.
using FieldTuple =
    std::tuple<std::string, std::string, Eigen::MatrixXd, std::string, std::vector<std::string>, std::string>;

Scene sceneOf(std::string title, const Doubles& points, const Integers& faces, Points normals,
              const std::vector<FieldTuple>& fields, Points line) {
  const std::map<std::string, FieldKind> kinds = {
      {"scalar", FieldKind::scalar}, {"diverging", FieldKind::diverging}, {"distance", FieldKind::distance},
      {"label", FieldKind::label},   {"vector", FieldKind::vector},       {"coordinates", FieldKind::coordinates},
      {"color", FieldKind::color},   {"positive", FieldKind::positive},   {"direction", FieldKind::direction}};
  Scene scene = {.title = std::move(title),
                 .positions = pointsOf(points),
                 .triangles = trianglesOf(faces),
                 .normals = std::move(normals)};
  for (const auto& [name, kind, values, unit, label_names, no_value] : fields)
    scene.fields.push_back(
        {name, chosen<FieldKind>("picture: kind", kind, kinds), values, unit, label_names, no_value});
  scene.path = std::move(line);
  return scene;
}

/// What pages and pictures share: field, column, color_map, and the camera's angles, zoom, up and projection.
template <class Options>
Options lookOf(const py::dict& given) {
  Options options;
  options.field = given["field"].cast<int>();
  options.column = given["column"].cast<int>();
  options.color_map = given["color_map"].cast<std::string>();
  options.camera.azimuth = given["azimuth"].cast<std::optional<double>>();
  options.camera.elevation = given["elevation"].cast<std::optional<double>>();
  options.camera.zoom = given["zoom"].cast<double>();
  options.camera.up = given["up"].cast<Eigen::Vector3d>();
  options.camera.is_parallel = given["is_parallel"].cast<bool>();
  return options;
}

std::string page(const Scene& scene, const py::dict& given) {
  const auto options = lookOf<PageOptions>(given);
  return run(py::none(), [&](const Progress&) { return pageOf(scene, options); });
}

/// The bytes of a PNG file.
py::bytes picture(const Scene& scene, const py::dict& given, const std::array<int, 2>& size,
                  const std::string& background, std::optional<std::array<double, 2>> range,
                  std::optional<bool> isolines, bool light, bool legend, int threads) {
  auto options = lookOf<PictureOptions>(given);
  options.width = size[0];
  options.height = size[1];
  options.background = chosen<Background>(
      "picture: background", background,
      {{"white", Background::white}, {"dark", Background::dark}, {"transparent", Background::transparent}});
  options.range = range;
  options.isolines = isolines;
  options.light = light;
  options.legend = legend;
  options.threads = threads;
  return run(py::none(), [&](const Progress&) { return pngOf(drawPicture(scene, options)); });
}

}  // namespace

void addView(py::module_& module) {
  py::class_<Scene>(module, "Scene").def(py::init(&sceneOf));
  module.def("page", &page);
  module.def("picture", &picture);
}

}  // namespace tufted::python
