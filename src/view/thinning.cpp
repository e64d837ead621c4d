#include "view/thinning.h"

#include <algorithm>

#include "view/projection.h"
#include "view/shown_values.h"
#include "view/spacing.h"

namespace tufted::view {

std::vector<int> thinned(const Scene& scene, Eigen::Index most) {
  if (most <= 0 || scene.positions.rows() <= most || scene.triangles.rows() > 0) return {};
  const std::vector<int> order = mortonOrder(normalize(scene, 0));
  const Eigen::Index count = std::ssize(order);
  if (count <= most) return {};
  std::vector<int> rows;
  for (Eigen::Index k = 0; k < most; ++k) rows.push_back(order[static_cast<std::size_t>(k * count / most)]);
  for (const SceneField& field : scene.fields) {
    const std::vector<int> sources = sourcesOf(field.kind, shownValues(field, 0));
    rows.insert(rows.end(), sources.begin(), sources.end());
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

Scene sceneOfRows(const Scene& scene, const std::vector<int>& rows) {
  Scene part = {.title = scene.title, .positions = scene.positions(rows, Eigen::all)};
  if (scene.normals.rows() > 0) part.normals = scene.normals(rows, Eigen::all);
  for (const SceneField& field : scene.fields)
    part.fields.push_back({field.name, field.kind, field.values(rows, Eigen::all), field.unit, field.label_names,
                           field.no_value, field.column_names});
  part.unit = scene.unit;
  part.path = scene.path;
  return part;
}

}  // namespace tufted::view
