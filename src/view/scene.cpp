#include "tufted/view/scene.h"

#include "tufted/errors.h"

namespace tufted {

namespace {

[[noreturn]] void refuse(const char* function, const std::string& what) {
  throw InvalidInput(std::string(function) + ": " + what);
}

/// Number of columns that values of a kind must have; 0: any number.
Eigen::Index columnsOf(FieldKind kind) {
  switch (kind) {
    case FieldKind::vector:
    case FieldKind::color:
    case FieldKind::direction:
      return 3;
    case FieldKind::coordinates:
      return 2;
    default:
      return 0;
  }
}

}  // namespace

void checkScene(const Scene& scene, const char* function) {
  const Eigen::Index n = scene.positions.rows();
  const auto is_point = [n](int corner) { return corner >= 0 && corner < n; };
  if (scene.normals.rows() != 0 && scene.normals.rows() != n)
    refuse(function, std::to_string(scene.normals.rows()) + " normals, must be " + std::to_string(n) + " or none");
  for (Eigen::Index t = 0; t < scene.triangles.rows(); ++t)
    for (const int corner : scene.triangles.row(t))
      if (!is_point(corner))
        refuse(function, "corner " + std::to_string(corner) + " of triangle " + std::to_string(t) +
                             ", must be at least 0 and less than " + std::to_string(n));
  for (const SceneField& field : scene.fields) {
    if (field.values.rows() != n)
      refuse(function, "field " + field.name + " has " + std::to_string(field.values.rows()) + " rows, must have " +
                           std::to_string(n));
    const Eigen::Index columns = columnsOf(field.kind);
    if (field.values.cols() == 0 || (columns != 0 && field.values.cols() != columns))
      refuse(function, "field " + field.name + " has " + std::to_string(field.values.cols()) + " columns, must have " +
                           (columns == 0 ? "at least 1" : std::to_string(columns)));
  }
}

}  // namespace tufted
