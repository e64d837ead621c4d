#include "tufted/view/page.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "tufted/errors.h"
#include "view/color_maps.h"
#include "view/marks.h"
#include "view/page_parts.h"
#include "view/projection.h"
#include "view/shown_values.h"
#include "view/spacing.h"
#include "view/viewer.h"

namespace tufted {

namespace {

using Json = nlohmann::json;
using view::LabelColumn;
using view::LevelColumn;
using view::PageBlocks;

/// Stored radii per factor of two: they are 19 % apart, and take nearly half a byte per point.
constexpr double radius_steps = 4;
/// The byte that stands for the lower quartile of the radii: the middle of all bytes.
constexpr std::uint8_t radius_middle = 128;
/// Any viewport: only the direction of the eye is used, which does not depend on its size.
constexpr view::Viewport some_viewport = {.left = 0, .right = 800, .top = 0, .bottom = 600};

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("pageOf: " + what);
}

void checkOptions(const Scene& scene, const PageOptions& options) {
  const auto fields = static_cast<int>(scene.fields.size());
  if (options.field < -1 || options.field >= std::max(fields, 1))
    refuse("field " + std::to_string(options.field) + ", must be at least -1 and less than " + std::to_string(fields));
  const Eigen::Index columns =
      fields > 0 && options.field >= 0 ? scene.fields[static_cast<std::size_t>(options.field)].values.cols() : 1;
  if (options.column < 0 || options.column >= columns)
    refuse("column " + std::to_string(options.column) + ", must be at least 0 and less than " +
           std::to_string(columns));
  if (!options.color_map.empty()) colorMap(options.color_map, "pageOf");
  view::checkCamera(options.camera, "pageOf");
}

const char* nameOf(FieldKind kind) {
  constexpr const char* names[] = {"scalar", "positive",    "diverging", "distance", "label",
                                   "vector", "coordinates", "color",     "direction"};
  return names[static_cast<int>(kind)];
}

const char* nameOf(MapUse use) {
  constexpr const char* names[] = {"sequential", "diverging", "categorical"};
  return names[static_cast<int>(use)];
}

Json levelColumn(const Eigen::Ref<const Eigen::VectorXd>& values, PageBlocks& blocks) {
  const LevelColumn column = view::levelsOf(values);
  Json json = {{"least", column.least},     {"step", column.step},
               {"minimum", column.minimum}, {"maximum", column.maximum},
               {"low", column.low},         {"high", column.high},
               {"finite", column.finite},   {"levels", blocks.add(column.levels)}};
  if (!column.far_rows.empty())
    json["far"] = {{"rows", blocks.add(column.far_rows)}, {"values", blocks.add(column.far_values)}};
  return json;
}

Json labelColumn(const Eigen::Ref<const Eigen::VectorXd>& values, PageBlocks& blocks) {
  const LabelColumn column = view::labelsOf(values);
  return {{"names", blocks.add(column.names)}, {"indices", blocks.add(column.indices)}};
}

/// A column of integers, each with the bytes red, green, blue and 255, or 0 if a value is not finite.
Json colorColumn(const Eigen::MatrixXd& values, PageBlocks& blocks) {
  std::vector<std::uint32_t> colors(static_cast<std::size_t>(values.rows()));
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    if (!values.row(row).allFinite()) continue;
    std::uint32_t color = 255u << 24;
    for (int channel = 0; channel < 3; ++channel)
      color |= static_cast<std::uint32_t>(std::lround(std::clamp(values(row, channel), 0.0, 255.0))) << (8 * channel);
    colors[static_cast<std::size_t>(row)] = color;
  }
  return {{"colors", blocks.add(colors)}};
}

Json rangesJson(const view::ValueRanges& ranges) {
  const auto json = [](const view::ValueRange& range) { return Json{range.low, range.high}; };
  return {{"usual", json(ranges.usual)}, {"all", json(ranges.all)}, {"middle", json(ranges.middle)}};
}

/// A column of values as shown, with the ranges of its colour map; those of vectors and coordinates are in fieldJson().
Json valueColumn(const SceneField& field, int column, PageBlocks& blocks) {
  if (showsAllColumns(field.kind)) return levelColumn(field.values.col(column), blocks);
  const Eigen::VectorXd values = view::shownValues(field, column);
  Json json = levelColumn(values, blocks);
  json["ranges"] = rangesJson(view::rangesOf(field.kind, values));
  return json;
}

Json fieldJson(const SceneField& field, PageBlocks& blocks) {
  Json columns = Json::array();
  if (field.kind == FieldKind::color)
    columns.push_back(colorColumn(field.values, blocks));
  else
    for (Eigen::Index column = 0; column < field.values.cols(); ++column)
      columns.push_back(field.kind == FieldKind::label ? labelColumn(field.values.col(column), blocks)
                                                       : valueColumn(field, static_cast<int>(column), blocks));
  Json json = {{"name", field.name},
               {"kind", nameOf(field.kind)},
               {"unit", field.unit},
               {"map", defaultColorMap(field.kind)},
               {"names", field.label_names},
               {"noValue", field.no_value},
               {"columns", std::move(columns)},
               {"columnNames", field.column_names}};
  const bool is_length = showsAllColumns(field.kind) && field.kind != FieldKind::color;
  if (field.kind == FieldKind::distance || is_length)
    for (Eigen::Index column = 0; column < (is_length ? 1 : field.values.cols()); ++column)
      json["columns"][static_cast<std::size_t>(column)]["sources"] =
          view::sourcesOf(field.kind, view::shownValues(field, static_cast<int>(column)));
  if (is_length) json["ranges"] = rangesJson(view::rangesOf(field.kind, view::shownValues(field, 0)));
  return json;
}

/// The radius of each point's disc, as a byte relative to the lower quartile, see `radius_steps`.
Json radiusJson(const Scene& scene, const view::NormalizedPoints& points, PageBlocks& blocks) {
  const std::vector<float> radii = view::discsOf(scene, points, 0).radii;
  std::vector<float> sorted;
  for (const int i : points.finite) sorted.push_back(radii[static_cast<std::size_t>(i)]);
  const auto quartile = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 4);
  std::nth_element(sorted.begin(), quartile, sorted.end());
  std::vector<std::uint8_t> steps(radii.size(), radius_middle);
  for (const int i : points.finite) {
    const double factor = radii[static_cast<std::size_t>(i)] / *quartile;
    const double step = std::round(radius_steps * std::log2(factor));
    steps[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::clamp(step + radius_middle, 0.0, 255.0));
  }
  return {{"quartile", std::ldexp(*quartile / points.unit, points.exponent)},
          {"step", 1 / radius_steps},
          {"block", blocks.add(steps)}};
}

int normalBlock(const Points& normals, PageBlocks& blocks) {
  std::vector<std::uint8_t> bytes(2 * static_cast<std::size_t>(normals.rows()));
  for (Eigen::Index row = 0; row < normals.rows(); ++row)
    view::octahedralBytes(normals.row(row).transpose(), &bytes[2 * static_cast<std::size_t>(row)]);
  return blocks.add(bytes);
}

Json mapsJson() {
  Json maps = Json::array();
  for (const ColorMap& map : colorMaps()) {
    std::string bytes;
    for (const Rgb& color : map.colors) bytes.append(color.begin(), color.end());
    maps.push_back({{"name", map.name}, {"use", nameOf(map.use)}, {"colors", view::base64(bytes)}});
  }
  return maps;
}

/// The scene as JSON, which refers to the blocks of numbers that are added to `blocks`.
/// @param rows indices that the caller gives the points; empty: their own
Json sceneJson(const Scene& scene, const PageOptions& options, const std::vector<int>& rows, PageBlocks& blocks) {
  const view::NormalizedPoints points = view::normalize(scene, 0);
  const view::Projection seen = view::project(points, options.camera, some_viewport);
  Json json = {{"title", scene.title},
               {"unit", scene.unit},
               {"count", scene.positions.rows()},
               {"positions", Json::array()},
               {"fields", Json::array()},
               {"maps", mapsJson()},
               {"noValue", no_value_color},
               {"none", none_color},
               {"pathColor", view::path_color},
               {"start",
                {{"field", options.field},
                 {"column", options.column},
                 {"map", options.color_map},
                 {"eye", {seen.back.x(), seen.back.y(), seen.back.z()}},
                 {"up", {seen.up.x(), seen.up.y(), seen.up.z()}},
                 {"zoom", options.camera.zoom},
                 {"parallel", options.camera.is_parallel}}}};
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd coordinates;  // stays empty without points, when there is no column to map
    if (scene.positions.rows() > 0) coordinates = scene.positions.col(axis);
    json["positions"].push_back(levelColumn(coordinates, blocks));
  }
  if (!rows.empty()) json["numbers"] = blocks.add(std::vector<std::uint32_t>(rows.begin(), rows.end()));
  if (!points.finite.empty()) json["radii"] = radiusJson(scene, points, blocks);
  if (scene.normals.rows() > 0) json["normals"] = normalBlock(scene.normals, blocks);
  if (scene.triangles.rows() > 0)
    json["triangles"] =
        blocks.add(std::vector<std::uint32_t>(scene.triangles.data(), scene.triangles.data() + scene.triangles.size()));
  if (scene.path.rows() > 0)
    json["path"] = blocks.add(std::vector<double>(scene.path.data(), scene.path.data() + scene.path.size()));
  for (const SceneField& field : scene.fields) json["fields"].push_back(fieldJson(field, blocks));
  return json;
}

/// JSON for an element of HTML: `<`, which occurs only in strings, is written as \u003c.
std::string jsonInHtml(const Json& json) {
  const std::string plain = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  std::string text;
  text.reserve(plain.size());
  for (const char c : plain) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

}  // namespace

std::string pageOf(const Scene& scene, const PageOptions& options) {
  checkScene(scene, "pageOf");
  checkOptions(scene, options);
  PageBlocks blocks;
  const std::vector<int> rows = view::thinned(scene, options.most_points);
  Json parts = sceneJson(rows.empty() ? scene : view::sceneOfRows(scene, rows), options, rows, blocks);
  const auto is_finite = [](const auto& position) { return position.allFinite(); };
  parts["finiteCount"] = std::count_if(scene.positions.rowwise().begin(), scene.positions.rowwise().end(), is_finite);
  const std::string json = jsonInHtml(parts);
  const std::size_t place = view::viewer.find(view::scene_mark);
  std::string page;
  page.reserve(view::viewer.size() + json.size() + blocks.html().size() + 100);
  page += view::viewer.substr(0, place);
  page += "<script type=\"application/json\" id=\"scene\">" + json + "</script>\n";
  page += blocks.html();
  page += view::viewer.substr(place + view::scene_mark.size());
  return page;
}

WholeFile preparePage(const std::filesystem::path& path, const Scene& scene, const PageOptions& options) {
  return {path, pageOf(scene, options)};
}

void writePage(const std::filesystem::path& path, const Scene& scene, const PageOptions& options) {
  preparePage(path, scene, options).giveName();
}

}  // namespace tufted
