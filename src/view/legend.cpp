#include "view/legend.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "view/marks.h"
#include "view/shown_values.h"
#include "view/ticks.h"

namespace tufted::view {
namespace {

/// A picture of fewer pixels in width or height has no title or legend.
constexpr int least_width = 240;
constexpr int least_height = 160;
/// Most labels that a legend lists: the map has no more colours.
constexpr std::size_t most_swatches = 20;
/// The width of the legend, in letter sizes: the bar and numbers of seven characters.
constexpr double legend_width = 9;
/// The width of the legend's bar and the height of its lines, in letter sizes.
constexpr double bar_width = 1.3;
constexpr double line_height = 1.4;
/// The letters of a text that is too long are made smaller by at most this factor.
constexpr double smallest_letters = 0.7;
/// Such a text fills this share of the width, because letter sizes are rounded to a 64th of a pixel.
constexpr double fitted_share = 0.99;

/// The labels that occur, ascending, up to one more than the legend lists.
std::set<long long> labelsIn(const SceneField& field, int column) {
  std::set<long long> labels;
  for (Eigen::Index i = 0; i < field.values.rows(); ++i) {
    const double value = field.values(i, column);
    if (std::isfinite(value) && value >= 0 && value < 1e15) labels.insert(static_cast<long long>(value));
    if (labels.size() > most_swatches) labels.erase(std::prev(labels.end()));
  }
  return labels;
}

std::string headingOf(const FieldColors& colors, const PictureOptions& options) {
  std::string text = colors.field->name;
  const auto column = static_cast<std::size_t>(options.column);
  if (column < colors.field->column_names.size()) return colors.field->column_names[column];
  if (!showsAllColumns(colors.field->kind) && colors.field->values.cols() > 1)
    text.append(" ").append(std::to_string(options.column));
  return text;
}

/// Writes a text into a width: in smaller letters if it is too long, and shortened if that does not suffice.
void writeWithin(const std::string& text, double x, double y, double size, double width, const Rgb& ink,
                 Canvas& canvas) {
  const double wanted = canvas.widthOf(text, size);
  if (wanted > width) size *= std::max(smallest_letters, fitted_share * width / wanted);
  canvas.text(canvas.shorten(text, size, width), x, y, size, ink);
}

/// Splits a heading that is too long into two lines after a word, if one fits.
std::vector<std::string> linesOf(const std::string& heading, double size, double width, Canvas& canvas) {
  if (canvas.widthOf(heading, size) <= width) return {heading};
  std::size_t best = 0;
  for (std::size_t at = 1; at < heading.size(); ++at) {
    const bool ends_word = std::string_view(" _-./").find(heading[at - 1]) != std::string_view::npos;
    if (ends_word && canvas.widthOf(heading.substr(0, at), size) <= width) best = at;
  }
  if (best == 0) return {heading};
  return {heading.substr(0, best), heading.substr(best)};
}

}  // namespace

Layout layoutOf(const Scene& scene, const FieldColors& colors, const PictureOptions& options) {
  Layout layout = {.text_size = std::clamp(0.021 * std::min(options.height, options.width), 10.0, 60.0),
                   .top = 0,
                   .right = options.width};
  if (!options.legend || options.width < least_width || options.height < least_height) return layout;
  const double em = layout.text_size;
  if (!scene.title.empty()) layout.top = static_cast<int>(2.6 * em);
  layout.has_legend = colors.field != nullptr && colors.field->kind != FieldKind::color;
  if (layout.has_legend) layout.right = options.width - static_cast<int>(legend_width * em);
  return layout;
}

void drawLegend(const Scene& scene, const FieldColors& colors, const PictureOptions& options, const Layout& layout,
                Canvas& canvas) {
  const double em = layout.text_size;
  const Rgb ink = options.background == Background::dark ? Rgb{232, 232, 232} : Rgb{32, 32, 32};
  if (layout.top > 0) writeWithin(scene.title, em, 1.9 * em, 1.2 * em, options.width - 2 * em, ink, canvas);
  if (!layout.has_legend) return;
  const int left = layout.right + static_cast<int>(0.7 * em);
  const double width = options.width - left - 0.4 * em;
  double y = layout.top + 2 * em;
  for (const std::string& line : linesOf(headingOf(colors, options), em, width, canvas)) {
    writeWithin(line, left, y, em, width, ink, canvas);
    y += line_height * em;
  }
  y -= line_height * em;
  const bool is_bar = colors.map != nullptr && colors.map->use != MapUse::categorical;
  const Ticks ticks = !is_bar                 ? Ticks{}
                      : colors.is_logarithmic ? logarithmicTicksOf(colors.low, colors.high)
                                              : ticksOf(colors.low, colors.high);
  std::string scale = ticks.exponent == 0 ? "" : "\u00d7 10" + raised(ticks.exponent) + " ";
  scale += colors.field->unit;
  if (ticks.offset != 0) {
    char text[32];
    std::snprintf(text, sizeof text, "%.15g +", ticks.offset);
    writeWithin(text, left, y += line_height * em, em, width, ink, canvas);
  }
  if (!scale.empty()) writeWithin(scale, left, y += line_height * em, em, width, ink, canvas);
  y += em;
  const auto swatch = [&](const Rgb& color, const std::string& name) {
    canvas.fill(left, static_cast<int>(y), left + static_cast<int>(bar_width * em), static_cast<int>(y + em), color);
    writeWithin(name, left + (bar_width + 0.5) * em, y + 0.86 * em, em, width - (bar_width + 0.5) * em, ink, canvas);
    y += 1.5 * em;
  };
  if (colors.field->kind == FieldKind::direction) {
    const char* const names[] = {"x", "y", "z", "-x", "-y", "-z"};
    for (int k = 0; k < 6; ++k) swatch(directionColor((k < 3 ? 1 : -1) * Eigen::Vector3d::Unit(k % 3)), names[k]);
  } else if (!is_bar) {
    const std::set<long long> labels = labelsIn(*colors.field, options.column);
    const auto room = static_cast<std::size_t>(std::max(1.0, (options.height - y - 3 * em) / (1.5 * em)));
    std::size_t count = 0;
    for (const long long label : labels) {
      if (count++ == std::min(room, most_swatches)) break;
      const std::vector<std::string>& names = colors.field->label_names;
      const bool is_named = label < static_cast<long long>(names.size());
      swatch(labelColor(*colors.map, static_cast<double>(label)),
             is_named ? names[static_cast<std::size_t>(label)] : std::to_string(label));
    }
    if (labels.size() > count) canvas.text("\u2026", left, y + 0.5 * em, em, ink);
    y += labels.size() > count ? 1.5 * em : 0;
  } else {
    const int top = static_cast<int>(y);
    const int bottom = static_cast<int>(std::min(y + 0.55 * options.height, options.height - 3.5 * em));
    const int bar_right = left + static_cast<int>(bar_width * em);
    for (int row = top; row < bottom; ++row)
      canvas.fill(left, row, bar_right, row + 1, colorAt(*colors.map, (bottom - row - 0.5) / (bottom - top)));
    for (std::size_t i = 0; i < ticks.values.size(); ++i) {
      const double span = colors.high - colors.low;
      const double share = span > 0 ? (ticks.values[i] - colors.low) / span : 0.5;
      const double at = bottom - share * (bottom - top);
      canvas.line(bar_right, at, bar_right + 0.35 * em, at, 1, ink);
      canvas.text(ticks.texts[i], bar_right + 0.6 * em, at + 0.36 * em, em, ink);
    }
    y = bottom + 0.8 * em;
    if (colors.step > 0) {
      char text[64];
      std::snprintf(text, sizeof text, colors.channels.size() > 1 ? "grid: %.3g" : "lines: %.3g", colors.step);
      writeWithin(text, left, y + em, 0.85 * em, width, ink, canvas);
      y += 1.7 * em;
    }
  }
  if (!colors.sources.empty()) {
    drawRing({left + 0.5 * bar_width * em, y + 0.5 * em}, em, canvas);
    writeWithin(colors.sources.size() == 1 ? "source" : "sources", left + (bar_width + 0.5) * em, y + 0.86 * em, em,
                width - (bar_width + 0.5) * em, ink, canvas);
    y += 1.5 * em;
  }
  const std::string& no_value = colors.field->no_value;
  if (colors.has_none) swatch(none_color, no_value.empty() ? "none" : no_value);
  if (colors.lacks_values)
    swatch(no_value_color, no_value.empty() || colors.field->kind == FieldKind::label ? "no value" : no_value);
}

}  // namespace tufted::view
