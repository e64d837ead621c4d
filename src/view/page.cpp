#include "tufted/view/page.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "tufted/errors.h"
#include "view/color_maps.h"
#include "view/page_block.h"
#include "view/page_columns.h"
#include "view/viewer.h"
#include "view/whole_file.h"

namespace tufted {

namespace {

using Json = nlohmann::json;
using view::LabelColumn;
using view::LevelColumn;
using view::PageBlocks;

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("pageOf: " + what);
}

void checkOptions(const Scene& scene, const PageOptions& options) {
  const auto fields = static_cast<int>(scene.fields.size());
  if (options.field < 0 || options.field >= std::max(fields, 1))
    refuse("field " + std::to_string(options.field) + ", must be at least 0 and less than " + std::to_string(fields));
  const Eigen::Index columns = fields > 0 ? scene.fields[static_cast<std::size_t>(options.field)].values.cols() : 1;
  if (options.column < 0 || options.column >= columns)
    refuse("column " + std::to_string(options.column) + ", must be at least 0 and less than " +
           std::to_string(columns));
  if (!options.color_map.empty()) colorMap(options.color_map, "pageOf");
  if (!options.eye.allFinite() || !options.up.allFinite()) refuse("eye and up must be finite");
}

const char* nameOf(FieldKind kind) {
  switch (kind) {
    case FieldKind::scalar:
      return "scalar";
    case FieldKind::diverging:
      return "diverging";
    case FieldKind::distance:
      return "distance";
    case FieldKind::label:
      return "label";
    case FieldKind::vector:
      return "vector";
    case FieldKind::coordinates:
      return "coordinates";
    case FieldKind::color:
      return "color";
  }
  return "scalar";
}

const char* nameOf(MapUse use) {
  switch (use) {
    case MapUse::sequential:
      return "sequential";
    case MapUse::diverging:
      return "diverging";
    case MapUse::categorical:
      return "categorical";
  }
  return "sequential";
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

/// Red, green, blue and 255, or four zeros where one of them is not finite, in one integer each.
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

Json fieldJson(const SceneField& field, PageBlocks& blocks) {
  Json columns = Json::array();
  if (field.kind == FieldKind::color)
    columns.push_back(colorColumn(field.values, blocks));
  else
    for (Eigen::Index column = 0; column < field.values.cols(); ++column)
      columns.push_back(field.kind == FieldKind::label ? labelColumn(field.values.col(column), blocks)
                                                       : levelColumn(field.values.col(column), blocks));
  return {{"name", field.name},
          {"kind", nameOf(field.kind)},
          {"unit", field.unit},
          {"map", defaultColorMap(field.kind)},
          {"columns", std::move(columns)}};
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

/// The scene but for its blocks of numbers, which are added to `blocks`.
Json sceneJson(const Scene& scene, const PageOptions& options, PageBlocks& blocks) {
  Json json = {{"title", scene.title},
               {"unit", scene.unit},
               {"count", scene.positions.rows()},
               {"positions", Json::array()},
               {"fields", Json::array()},
               {"maps", mapsJson()},
               {"noValue", no_value_color},
               {"start",
                {{"field", options.field},
                 {"column", options.column},
                 {"map", options.color_map},
                 {"eye", {options.eye.x(), options.eye.y(), options.eye.z()}},
                 {"up", {options.up.x(), options.up.y(), options.up.z()}}}}};
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd coordinates;  // of no points a column would be an offset to nothing
    if (scene.positions.rows() > 0) coordinates = scene.positions.col(axis);
    json["positions"].push_back(levelColumn(coordinates, blocks));
  }
  if (scene.normals.rows() > 0) json["normals"] = normalBlock(scene.normals, blocks);
  if (scene.triangles.rows() > 0)
    json["triangles"] =
        blocks.add(std::vector<std::uint32_t>(scene.triangles.data(), scene.triangles.data() + scene.triangles.size()));
  for (const SceneField& field : scene.fields) json["fields"].push_back(fieldJson(field, blocks));
  return json;
}

/// JSON that may stand inside of an element of HTML: `<` only occurs in texts, where \u003c means the same.
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
  const std::string json = jsonInHtml(sceneJson(scene, options, blocks));
  const std::size_t place = view::viewer.find(view::scene_mark);
  std::string page;
  page.reserve(view::viewer.size() + json.size() + blocks.html().size() + 100);
  page += view::viewer.substr(0, place);
  page += "<script type=\"application/json\" id=\"scene\">" + json + "</script>\n";
  page += blocks.html();
  page += view::viewer.substr(place + view::scene_mark.size());
  return page;
}

void writePage(const std::filesystem::path& path, const Scene& scene, const PageOptions& options) {
  view::writeWholeFile(path, pageOf(scene, options));
}

}  // namespace tufted
