#include "scene_fields.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <utility>

namespace {

using tufted::FieldKind;
using tufted::SceneField;

}  // namespace

bool isShown(const std::string& name) {
  return !isOneOf(name, {"evals", "principal_directions", "frames", "measured_positions", "component_edges", "M",
                         "corner_uv", "status", "representative", "components", "path", "isolines"});
}

FieldKind kindOfResult(const std::string& name, Eigen::Index columns) {
  static const std::map<std::string, FieldKind> meanings = {{"evecs", FieldKind::diverging},
                                                            {"embedding", FieldKind::diverging},
                                                            {"curvature", FieldKind::diverging},
                                                            {"green", FieldKind::diverging},
                                                            {"u", FieldKind::diverging},
                                                            {"distance", FieldKind::distance},
                                                            {"signed_distance", FieldKind::diverging},
                                                            {"labels", FieldKind::label},
                                                            {"label", FieldKind::label},
                                                            {"component", FieldKind::label},
                                                            {"components", FieldKind::label},
                                                            {"boundary", FieldKind::label},
                                                            {"status", FieldKind::label},
                                                            {"classification", FieldKind::label},
                                                            {"vectors", FieldKind::vector},
                                                            {"normals", FieldKind::direction},
                                                            {"logmap", FieldKind::coordinates},
                                                            {"uv", FieldKind::coordinates},
                                                            {"color", FieldKind::color},
                                                            {"mass", FieldKind::positive},
                                                            {"noise", FieldKind::positive},
                                                            {"hks", FieldKind::positive}};
  const auto kind = meanings.find(name);
  if (kind == meanings.end()) return FieldKind::scalar;
  if (kind->second == FieldKind::coordinates) return columns == 2 ? kind->second : FieldKind::scalar;
  return !tufted::showsAllColumns(kind->second) || columns == 3 ? kind->second : FieldKind::scalar;
}

std::vector<std::string> columnNamesOf(const std::string& name, Eigen::Index columns) {
  if (name == "logmap") return {"logarithmic map"};
  if (name == "curvature" && (columns == 1 || columns == 4))
    return {"mean H", "Gaussian K", "greatest k1", "least k2"};  // names short enough for legends
  if (name == "image" && columns == 3) return {"x of the image", "y of the image", "z of the image"};
  std::vector<std::string> names;
  for (Eigen::Index k = 0; name == "evecs" && k < columns; ++k) names.push_back("eigenvector " + std::to_string(k));
  return names;
}

SceneField placeField(const std::string& name, const tufted::Scene& scene) {
  if (name == "normal" && scene.normals.rows() > 0) return {name, FieldKind::direction, scene.normals};
  const std::array<const char*, 6> axes = {"x", "y", "z", "-x", "-y", "-z"};
  const auto axis = std::find(axes.begin(), axes.end(), name) - axes.begin();
  if (axis == std::ssize(axes)) return {};
  return {name, FieldKind::scalar, (axis < 3 ? 1 : -1) * scene.positions.col(axis % 3), scene.unit};
}

SceneField boundaryField(Eigen::MatrixXd values) {
  values.array() -= 1;  // Boundary::none becomes -1, drawn grey
  return {.name = "boundary",
          .kind = FieldKind::label,
          .values = std::move(values),
          .label_names = {"rim", "jump", "lost"},
          .no_value = "none"};
}

std::vector<SceneField> fieldsOf(const tufted::Geometry& geometry) {
  const Eigen::Index n = geometry.points.rows();
  std::vector<SceneField> fields;
  Eigen::MatrixXd color;
  for (const tufted::Field& field : geometry.fields) {
    if (tufted::isPackedColor(field)) {
      color = valuesOf(field, n);
    } else if (isOneOf(field.name, {"red", "green", "blue"})) {
      if (color.rows() != n) color = Eigen::MatrixXd::Zero(n, 3);
      const double scale = field.type == tufted::FieldType::uint16 ? 1.0 / 257 : 1;
      color.col(field.name == "red" ? 0 : field.name == "green" ? 1 : 2) = scale * valuesOf(field, n).col(0);
    } else if (field.count > 0) {
      fields.push_back({.name = field.name,
                        .kind = kindOfResult(field.name, field.count),
                        .values = valuesOf(field, n),
                        .column_names = columnNamesOf(field.name, field.count)});
    }
  }
  if (color.rows() == n && color.cols() == 3) fields.insert(fields.begin(), {"color", FieldKind::color, color});
  return fields;
}

tufted::Scene sceneOf(const std::string& title, const tufted::Geometry& geometry, const tufted::Laplacian& laplacian,
                      const std::vector<tufted::ResultArray>& arrays) {
  tufted::Scene scene = {.title = title, .positions = geometry.points};
  const Eigen::Index n = geometry.points.rows();
  if (geometry.is_mesh) scene.triangles = geometry.triangles;
  if (geometry.normals.rows() == n)
    scene.normals = geometry.normals;
  else if (laplacian.frames.normals.rows() == n)
    scene.normals = laplacian.frames.normals;
  for (const tufted::ResultArray& array : arrays) {
    if (array.name == "path") scene.path = array.values;
    if (isShown(array.name) && array.values.rows() == n && array.values.cols() > 0)
      scene.fields.push_back({.name = array.name,
                              .kind = kindOfResult(array.name, array.values.cols()),
                              .values = array.values,
                              .column_names = columnNamesOf(array.name, array.values.cols())});
  }
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto takes_part = [&](Eigen::Index i) {
    const auto at = static_cast<std::size_t>(i);
    return laplacian.status.empty() || laplacian.status[at] == tufted::PointStatus::active ||
           laplacian.status[at] == tufted::PointStatus::coincident;
  };
  for (SceneField& field : scene.fields) {
    if (field.kind == FieldKind::label) continue;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!takes_part(i)) field.values.row(i).setConstant(nan);
  }
  const auto has_part = [&](std::size_t size) { return n > 0 && static_cast<Eigen::Index>(size) == n; };
  if (has_part(static_cast<std::size_t>(laplacian.M.size()))) {
    Eigen::MatrixXd mass = laplacian.M;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!(mass(i, 0) > 0)) mass(i, 0) = nan;
    scene.fields.push_back({"mass", FieldKind::positive, std::move(mass)});
  }
  if (has_part(laplacian.boundary.size())) {
    Eigen::MatrixXd boundary(n, 1);
    for (Eigen::Index i = 0; i < n; ++i)
      boundary(i, 0) = takes_part(i) ? static_cast<double>(laplacian.boundary[static_cast<std::size_t>(i)]) : nan;
    scene.fields.push_back(boundaryField(std::move(boundary)));
  }
  if (has_part(laplacian.component.size())) {
    Eigen::MatrixXd component(n, 1);
    for (Eigen::Index i = 0; i < n; ++i) component(i, 0) = laplacian.component[static_cast<std::size_t>(i)];
    scene.fields.push_back({"component", FieldKind::label, std::move(component)});
  }
  for (SceneField& field : fieldsOf(geometry)) {
    const auto is_same = [&](const SceneField& other) { return other.name == field.name; };
    if (std::none_of(scene.fields.begin(), scene.fields.end(), is_same)) scene.fields.push_back(std::move(field));
  }
  return scene;
}

Eigen::MatrixXd valuesOf(const tufted::Field& field, Eigen::Index points) {
  const bool is_packed = tufted::isPackedColor(field);
  Eigen::MatrixXd values(points, is_packed ? 3 : field.count);
  for (Eigen::Index i = 0; i < points; ++i) {
    std::uint32_t packed = 0;
    if (is_packed) std::memcpy(&packed, field.bytes.data() + 4 * i, 4);
    for (Eigen::Index c = 0; c < values.cols(); ++c)
      values(i, c) = is_packed ? packed >> (16 - 8 * c) & 0xff
                               : tufted::valueOf(field, static_cast<std::size_t>(i * field.count + c));
  }
  return values;
}
