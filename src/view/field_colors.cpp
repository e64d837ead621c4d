#include "view/field_colors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "tufted/errors.h"
#include "tufted/view/colors.h"
#include "view/percentile.h"
#include "view/ticks.h"

namespace tufted::view {

namespace {

/// Isolines in the range of the values, about.
constexpr int isoline_count = 16;
/// Lines of coordinates on each side of the origin, about.
constexpr int grid_count = 10;
/// How far beyond the 1st and 99th percentile, in their distance, values still have colours of their own.
constexpr double reach = 0.5;

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("drawPicture: " + what);
}

void setRange(const PictureOptions& options, bool is_around_0, bool is_from_0, std::vector<double> values,
              FieldColors& colors) {
  double least = 0;
  double greatest = 0;
  if (!values.empty()) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    least = *low;
    greatest = *high;
    const double first = percentile(values, 0.01);
    const double last = percentile(values, 0.99);
    colors.low = std::max(least, first - reach * (last - first));
    colors.high = std::min(greatest, last + reach * (last - first));
    if (is_around_0) {
      colors.high = std::max(std::abs(colors.low), std::abs(colors.high));
      colors.low = -colors.high;
    }
    if (is_from_0) colors.low = std::min(0.0, colors.low);
  }
  if (options.range) {
    colors.low = (*options.range)[0];
    colors.high = (*options.range)[1];
  }
  colors.is_cut_low = least < colors.low;
  colors.is_cut_high = greatest > colors.high;
}

}  // namespace

Rgb FieldColors::colorOf(const std::array<float, 2>& values) const {
  if (!std::isfinite(values[0])) return no_value_color;
  double value = values[0];
  if (field->kind == FieldKind::coordinates) value = std::hypot(values[0], values[1]);
  const double span = high - low;
  if (!(span > 0)) return colorAt(*map, 0.5);
  return colorAt(*map, (value - low) / span);
}

Rgb FieldColors::colorOfPoint(int point) const {
  if (field == nullptr) return no_value_color;
  if (field->kind != FieldKind::color) return labelColor(*map, field->values(point, 0));
  Rgb color;
  for (int k = 0; k < 3; ++k) {
    const double value = field->values(point, k);
    if (!std::isfinite(value)) return no_value_color;
    color[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  }
  return color;
}

FieldColors colorsOf(const Scene& scene, const PictureOptions& options) {
  FieldColors colors;
  const auto count = static_cast<int>(scene.fields.size());
  if (options.field < -1 || (options.field >= count && (options.field != 0 || count > 0)))
    refuse("field " + std::to_string(options.field) + ", must be from -1 to " + std::to_string(count - 1));
  if (!options.color_map.empty()) colorMap(options.color_map, "drawPicture");
  if (options.range && !((*options.range)[0] < (*options.range)[1]))
    refuse("range " + std::to_string((*options.range)[0]) + " to " + std::to_string((*options.range)[1]) +
           ", must ascend");
  if (options.field < 0 || count == 0) return colors;
  const SceneField& field = scene.fields[static_cast<std::size_t>(options.field)];
  const bool is_whole =
      field.kind == FieldKind::vector || field.kind == FieldKind::coordinates || field.kind == FieldKind::color;
  const Eigen::Index columns = is_whole ? 1 : field.values.cols();
  if (options.column < 0 || options.column >= columns)
    refuse("column " + std::to_string(options.column) + " of field " + field.name + ", must be from 0 to " +
           std::to_string(columns - 1));
  colors.field = &field;
  const std::string map = options.color_map.empty() ? defaultColorMap(field.kind) : options.color_map;
  if (!map.empty()) colors.map = &colorMap(map, "drawPicture");
  const auto n = static_cast<std::size_t>(field.values.rows());
  if (field.kind == FieldKind::color) return colors;
  const bool is_label = colors.map->use == MapUse::categorical;
  std::vector<double> values;
  values.reserve(n);
  colors.channels.assign(field.kind == FieldKind::coordinates ? 2 : 1,
                         std::vector<float>(n, std::numeric_limits<float>::quiet_NaN()));
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    double value = 0;
    if (field.kind == FieldKind::coordinates || field.kind == FieldKind::vector)
      value = field.values.row(row).stableNorm();
    else
      value = field.values(row, options.column);
    if (!std::isfinite(value) || (field.kind == FieldKind::label && value < 0)) {
      colors.lacks_values = true;
      continue;
    }
    values.push_back(value);
    colors.channels[0][i] = static_cast<float>(value);
    if (field.kind != FieldKind::coordinates) continue;
    for (int k = 0; k < 2; ++k)
      colors.channels[static_cast<std::size_t>(k)][i] = static_cast<float>(field.values(row, k));
  }
  const bool is_length =
      field.kind == FieldKind::distance || field.kind == FieldKind::vector || field.kind == FieldKind::coordinates;
  setRange(options, colors.map->use == MapUse::diverging, is_length, std::move(values), colors);
  if (is_label) {
    colors.channels.clear();
    return colors;
  }
  if (field.kind == FieldKind::coordinates)
    colors.step = niceStep(colors.high, grid_count);
  else if (options.isolines.value_or(field.kind == FieldKind::distance))
    colors.step = niceStep(colors.high - colors.low, isoline_count);
  return colors;
}

}  // namespace tufted::view

namespace tufted {

std::vector<Rgb> pointColors(const Scene& scene, const PictureOptions& options) {
  checkScene(scene, "pointColors");
  const view::FieldColors colors = view::colorsOf(scene, options);
  std::vector<Rgb> all;
  for (Eigen::Index i = 0; i < scene.positions.rows(); ++i) {
    const auto point = static_cast<std::size_t>(i);
    const auto channel = [&](std::size_t c) { return c < colors.channels.size() ? colors.channels[c][point] : 0; };
    all.push_back(colors.isBlended() ? colors.colorOf({channel(0), channel(1)})
                                     : colors.colorOfPoint(static_cast<int>(i)));
  }
  return all;
}

}  // namespace tufted
