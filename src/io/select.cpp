#include "tufted/io/select.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "io/columns.h"
#include "io/number.h"
#include "io/steps.h"
#include "io/where.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

using Eigen::Index;
using Mask = std::vector<std::uint8_t>;  ///< 1 for points that are kept

void check(const Geometry& geometry, const Selection& selection) {
  if (geometry.is_mesh) throw InvalidInput("select: the geometry is a mesh, must be a cloud");
  if (selection.crop && !(selection.crop->min().array() <= selection.crop->max().array()).all())
    throw InvalidInput("select: the lower corner of crop exceeds the upper one in x, y or z, must not");
  if (const std::size_t corners = selection.polygon.size(); corners == 1 || corners == 2)
    throw InvalidInput("select: polygon has " + std::to_string(corners) + " corners, must have at least 3");
  constexpr double farthest = 1e150;  // products of two coordinates stay finite
  for (const Eigen::Vector2d& corner : selection.polygon)
    for (const double number : corner)
      if (!(std::abs(number) <= farthest))
        throw InvalidInput("select: polygon has a coordinate " + io::shortestText(number) +
                           ", must lie in [-1e150, 1e150]");
}

/// Clears the entries of points that do not satisfy the condition.
template <class Condition>
void require(Mask& kept, const Progress& progress, const Condition& condition) {
  for (std::size_t i = 0; i < kept.size(); ++i) {
    io::reportStep(progress, "select", i, kept.size());
    if (kept[i] != 0 && !condition(i)) kept[i] = 0;
  }
}

/// Whether a point lies in a polygon, by the rule of Selection::polygon.
bool isInside(const std::vector<Eigen::Vector2d>& corners, const Eigen::RowVector3d& point) {
  bool is_inside = false;
  const Eigen::Vector2d* last = &corners.back();
  for (const Eigen::Vector2d& corner : corners) {
    const bool is_upward = last->y() < corner.y();
    const Eigen::Vector2d &low = is_upward ? *last : corner, &high = is_upward ? corner : *last;
    last = &corner;
    if (point.y() >= low.y() && point.y() < high.y() &&
        (high.x() - low.x()) * (point.y() - low.y()) > (high.y() - low.y()) * (point.x() - low.x()))
      is_inside = !is_inside;
  }
  return is_inside;
}

}  // namespace

std::vector<int> io::chosenRows(const Geometry& geometry, const Selection& selection, const Progress& progress) {
  check(geometry, selection);
  const Points& points = geometry.points;
  Mask kept(static_cast<std::size_t>(points.rows()), 1);
  for (const std::string& comparison : selection.where) require(kept, progress, io::where(geometry, comparison));
  if (selection.crop)
    require(kept, progress, [&](std::size_t i) { return selection.crop->contains(points.row(i).transpose()); });
  if (!selection.polygon.empty())
    require(kept, progress, [&](std::size_t i) { return isInside(selection.polygon, points.row(i)); });
  std::vector<int> rows;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i] != 0) rows.push_back(static_cast<int>(i));
  if (selection.thin == 0) return rows;
  std::vector<int> thinned = thinPoints(points(rows, Eigen::all), selection.thin, progress);
  for (int& row : thinned) row = rows[static_cast<std::size_t>(row)];
  return thinned;
}

void io::refuseNone(std::int64_t points) {
  throw InvalidInput("select: none of the " + std::to_string(points) +
                     " points satisfies all conditions, must be at least one");
}

namespace {

/// Makes missing pixels of all points except the rows.
void blankOthers(Geometry& geometry, const std::vector<int>& rows) {
  Mask kept(static_cast<std::size_t>(geometry.points.rows()), 0);
  for (const int row : rows) kept[static_cast<std::size_t>(row)] = 1;
  for (Index i = 0; i < geometry.points.rows(); ++i) {
    if (kept[static_cast<std::size_t>(i)] != 0) continue;
    geometry.points.row(i).setConstant(std::numeric_limits<double>::quiet_NaN());
    if (geometry.normals.rows() > 0) geometry.normals.row(i).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
}

void dropOthers(Geometry& geometry, const std::vector<int>& rows) {
  geometry.points = geometry.points(rows, Eigen::all).eval();
  if (geometry.normals.rows() > 0) geometry.normals = geometry.normals(rows, Eigen::all).eval();
  for (Field& field : geometry.fields) {
    const std::size_t size = io::sizeOf(field.type) * static_cast<std::size_t>(field.count);
    for (std::size_t k = 0; k < rows.size() && size > 0; ++k)  // ascending, so nothing is overwritten before it moves
      std::memmove(&field.bytes[k * size], &field.bytes[static_cast<std::size_t>(rows[k]) * size], size);
    field.bytes.resize(rows.size() * size);
  }
  geometry.width = static_cast<int>(rows.size());
  removeFileRow(geometry);
  const auto* const bytes = reinterpret_cast<const std::byte*>(rows.data());
  geometry.fields.push_back({file_row, FieldType::int32, 1, {bytes, bytes + rows.size() * sizeof(int)}});
}

}  // namespace

void removeFileRow(Geometry& geometry) {
  std::erase_if(geometry.fields, [](const Field& field) { return field.name == file_row; });
}

std::vector<int> select(Geometry& geometry, const Selection& selection, const Progress& progress) {
  std::vector<int> rows = io::chosenRows(geometry, selection, progress);
  if (rows.empty() && geometry.points.rows() > 0) io::refuseNone(geometry.points.rows());
  if (geometry.height > 1)
    blankOthers(geometry, rows);
  else
    dropOthers(geometry, rows);
  return rows;
}

}  // namespace tufted
