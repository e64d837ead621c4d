#include "view/field_colors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "tufted/errors.h"
#include "tufted/view/picture.h"
#include "view/shown_values.h"
#include "view/ticks.h"

namespace tufted::view {
namespace {

/// About how many isolines the range of values has.
constexpr int isoline_count = 16;
/// About how many grid lines of coordinates lie on each side of the origin.
constexpr int grid_count = 10;
/// Shares of outliers are clamped to this, so that sums of floats do not overflow.
constexpr double farthest_share = 1e30;

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("drawPicture: " + what);
}

}  // namespace

float FieldColors::shareOf(double value) const {
  const double half_span = high / 2 - low / 2;  // halves, because high - low may overflow
  const double share = half_span > 0 ? (value / 2 - low / 2) / half_span : 0.5;
  return static_cast<float>(std::clamp(share, -farthest_share, farthest_share));
}

double FieldColors::shareOfStep() const {
  return step > 0 ? step / 2 / (high / 2 - low / 2) : 0;
}

double FieldColors::levelOf(float share) const {
  const double first = low / step;
  return std::floor(first - std::floor(first) + share / shareOfStep());
}

Rgb FieldColors::colorOf(const std::array<float, 2>& shares) const {
  if (!std::isfinite(shares[0])) return no_value_color;
  if (!(high > low)) return colorAt(*map, 0.5);
  return colorAt(*map, field->kind == FieldKind::coordinates ? std::hypot(shares[0], shares[1]) : shares[0]);
}

Rgb FieldColors::colorOfPoint(int point) const {
  if (field == nullptr) return none_color;
  if (field->kind == FieldKind::direction) return directionColor(field->values.row(point));
  if (field->kind != FieldKind::color) return labelColor(*map, field->values(point, column));
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
  const Eigen::Index columns = showsAllColumns(field.kind) ? 1 : field.values.cols();
  if (options.column < 0 || options.column >= columns)
    refuse("column " + std::to_string(options.column) + " of field " + field.name + ", must be from 0 to " +
           std::to_string(columns - 1));
  colors.field = &field;
  colors.column = options.column;
  const std::string map = options.color_map.empty() ? defaultColorMap(field.kind) : options.color_map;
  if (!map.empty()) colors.map = &colorMap(map, "drawPicture");
  const auto n = static_cast<std::size_t>(field.values.rows());
  if (field.kind == FieldKind::color || field.kind == FieldKind::direction) {
    colors.map = nullptr;
    for (Eigen::Index i = 0; i < field.values.rows() && !colors.lacks_values; ++i)
      colors.lacks_values =
          colors.colorOfPoint(static_cast<int>(i)) == no_value_color && scene.positions.row(i).allFinite();
    return colors;
  }
  const bool is_label = colors.map->use == MapUse::categorical;
  const bool is_pair = field.kind == FieldKind::coordinates;
  const Eigen::VectorXd values = shownValues(field, options.column);
  colors.is_logarithmic = isLogarithmic(field.kind);
  colors.sources = sourcesOf(field.kind, values);
  const ValueRange range = rangesOf(field.kind, values).usual;
  colors.low = range.low;
  colors.high = range.high;
  if (options.range) {
    colors.low = colors.is_logarithmic ? std::log10((*options.range)[0]) : (*options.range)[0];
    colors.high = colors.is_logarithmic ? std::log10((*options.range)[1]) : (*options.range)[1];
    if (!std::isfinite(colors.low)) refuse("range from " + std::to_string((*options.range)[0]) + ", must be positive");
  }
  colors.channels.assign(is_pair ? 2 : 1, std::vector<float>(n, std::numeric_limits<float>::quiet_NaN()));
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const bool is_none = field.kind == FieldKind::label && values[row] < 0;
    if (is_none || !std::isfinite(values[row])) {
      if (scene.positions.row(row).allFinite()) (is_none ? colors.has_none : colors.lacks_values) = true;
      continue;
    }
    for (std::size_t c = 0; c < colors.channels.size(); ++c)
      colors.channels[c][i] = colors.shareOf(is_pair ? field.values(row, static_cast<Eigen::Index>(c)) : values[row]);
  }
  if (is_label) {
    colors.channels.clear();
    return colors;
  }
  if (is_pair)
    colors.step = niceStep(colors.high, grid_count);
  else if (options.isolines.value_or(field.kind == FieldKind::distance) && !colors.is_logarithmic)
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
