#include "look.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "options.h"
#include "point_options.h"
#include "scene_fields.h"
#include "suggestion.h"
#include "tufted/errors.h"
#include "tufted/view/page.h"
#include "tufted/view/picture.h"
#include "tufted/view/scene.h"

namespace {

using tufted::FieldKind;
using tufted::SceneField;

const std::map<std::string, tufted::Background> backgrounds = {{"white", tufted::Background::white},
                                                               {"dark", tufted::Background::dark},
                                                               {"transparent", tufted::Background::transparent}};
const std::map<std::string, Eigen::Vector3d> axes = {
    {"x", Eigen::Vector3d::UnitX()},   {"y", Eigen::Vector3d::UnitY()},   {"z", Eigen::Vector3d::UnitZ()},
    {"-x", -Eigen::Vector3d::UnitX()}, {"-y", -Eigen::Vector3d::UnitY()}, {"-z", -Eigen::Vector3d::UnitZ()}};

/// Parses WIDTHxHEIGHT; false if it is none or out of range.
bool parseSize(const std::string& text, int& width, int& height) {
  char end = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%c", &width, &height, &end) != 2) return false;
  return std::min(width, height) >= 16 && std::max(width, height) <= 8192;
}

std::string checkSize(const std::string& text) {
  int width = 0;
  int height = 0;
  return parseSize(text, width, height) ? "" : text + " is not WIDTHxHEIGHT, from 16 to 8192 each";
}

void setCamera(const std::string& text, tufted::Camera& camera) {
  if (text == "top") {
    camera.azimuth = -90;
    camera.elevation = 90;
    camera.is_parallel = true;
    return;
  }
  const std::vector<double> numbers = parseNumbers(text, "--camera");
  const bool valid = (numbers.size() == 2 || numbers.size() == 3) && std::abs(numbers[1]) <= 90 &&
                     std::isfinite(numbers[0]) && (numbers.size() == 2 || (numbers[2] > 0 && numbers[2] <= 1000));
  if (!valid)
    throw CLI::ValidationError("--camera",
                               text +
                                   " is not top, AZIMUTH,ELEVATION or AZIMUTH,ELEVATION,ZOOM: degrees, the elevation "
                                   "from -90 to 90, the zoom positive and at most 1000");
  camera.azimuth = numbers[0];
  camera.elevation = numbers[1];
  if (numbers.size() == 3) camera.zoom = numbers[2];
}

std::string endingOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

/// Checks that a file can be written, and that its name has one of the `endings` of its format.
void checkFile(const std::string& option, const std::filesystem::path& file, const std::vector<std::string>& endings,
               const std::filesystem::path& out, const std::vector<NamedInput>& inputs) {
  if (file.empty()) return;
  const std::string name = option + " " + file.string();
  refuseOverwriting(name, file, inputs);
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status)) throw tufted::InvalidInput(name + ": is a directory");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw tufted::InvalidInput(name + ": is no regular file, must be one or missing");
  if (status.type() == std::filesystem::file_type::none)  // such as a cycle of links
    throw tufted::IoError(file.string() + ": cannot write: " + error.message());
  const std::filesystem::path target = behindLinks(file);
  for (const std::filesystem::path& path : {file, target})
    if (std::find(endings.begin(), endings.end(), endingOf(path)) == endings.end())
      throw tufted::InvalidInput(name + ": " + (path == file ? "its name" : "leads to " + path.string() + ", which") +
                                 " must end in " + endings[0]);
  if (isWithin(out, file)) throw tufted::InvalidInput(name + ": is a folder that --out " + out.string() + " makes");
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  if (!std::filesystem::exists(folder, error) && isWithin(out, folder)) return;
  if (!std::filesystem::is_directory(folder, error))
    throw tufted::IoError(file.string() + ": cannot write: there is no directory " + folder.string());
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw tufted::IoError(file.string() + ": cannot write: no permission in " + folder.string());
}

/// Adds the fields of a file by their names, colours as one field `color`.
void addFields(const tufted::Geometry& geometry, std::vector<ShownField>& fields) {
  for (const tufted::Field& field : geometry.fields) {
    const bool is_color = isOneOf(field.name, {"rgb", "rgba", "red", "green", "blue"});
    const ShownField shown = {is_color ? "color" : field.name, is_color ? 1 : field.count};
    const auto is_same = [&](const ShownField& other) { return other.name == shown.name; };
    if (std::none_of(fields.begin(), fields.end(), is_same)) fields.push_back(shown);
  }
}

[[noreturn]] void refuseColumn(int column, const std::string& field, Eigen::Index columns) {
  throw tufted::InvalidInput("--column " + std::to_string(column) + ": " + field + " has " + std::to_string(columns) +
                             (columns == 1 ? " column" : " columns") + ", counted from 0");
}

int indexOf(const tufted::Scene& scene, const std::string& name) {
  if (name.empty()) return 0;
  if (name == "none") return -1;
  std::vector<std::string> known = namesOf(scene.fields);
  if (const std::ptrdiff_t at = tufted::findField(known, name); at >= 0) return static_cast<int>(at);
  known.insert(known.end(), {"x", "y", "z"});
  throw tufted::InvalidInput("--color " + noneOf(name, known));
}

/// The first column that is not constant, or 0 if there is none; the first eigenvectors are constant.
int firstVarying(const Eigen::MatrixXd& columns) {
  constexpr double rounding = 1e-6;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    double least = std::numeric_limits<double>::infinity();
    double greatest = -least;
    for (const double value : columns.col(k)) {
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
    if (greatest - least > rounding * std::max(std::abs(least), std::abs(greatest))) return static_cast<int>(k);
  }
  return 0;
}

/// The options of the picture for the field that is shown.
tufted::PictureOptions pictureOf(const tufted::Scene& scene, const Look& look) {
  tufted::PictureOptions options = look.picture;
  options.field = indexOf(scene, look.color);
  if (scene.fields.empty() || options.field < 0) return options;
  const SceneField& field = scene.fields[static_cast<std::size_t>(options.field)];
  const bool has_columns = !tufted::showsAllColumns(field.kind);
  const Eigen::Index columns = has_columns ? field.values.cols() : 1;
  options.column = look.column.value_or(has_columns ? firstVarying(field.values) : 0);
  if (options.column >= columns) refuseColumn(options.column, field.name, columns);
  return options;
}

}  // namespace

void addPictureOptions(CLI::App& command, Look& look) {
  addText(command, "--png FILE.png", look.png, "Write a picture");
  addText(command, "--color FIELD", look.color,
          "Field to show; x, y, z or normal for places and directions; none for the shape alone (the first "
          "field; without one the height)");
  addNumber(command, "--column K", look.column, 0, std::numeric_limits<int>::max(),
            "Column of the field that is shown, counted from 0 (the first that is not constant)");
  const auto set_map = [&look](const std::string& name) { look.picture.color_map = name; };
  command
      .add_option_function<std::string>("--colormap", set_map,
                                        "Colours: viridis, cividis, magma, coolwarm, purple_green or labels "
                                        "(chosen by the meaning of the values)")
      ->check([](const std::string& name) { return refuseName(name, tufted::colorMapNames()); })
      ->type_name("NAME");
  const auto set_camera = [&look](const std::string& text) { setCamera(text, look.picture.camera); };
  command
      .add_option_function<std::string>(
          "--camera", set_camera,
          "Camera: degrees around the up axis, degrees above the horizon, zoom factor; or "
          "top, a plan in parallel projection (automatic, zoom 1)")
      ->type_name("AZIMUTH,ELEVATION[,ZOOM]");
  addChoice(command, "--up", look.picture.camera.up, axes,
            "Axis that points up in pictures, and towards which the normals of open sheets point (automatic)");
  const auto set_size = [&look](const std::string& text) { parseSize(text, look.picture.width, look.picture.height); };
  command.add_option_function<std::string>("--size", set_size, "Size of the picture in pixels (1200x900)")
      ->check(checkSize)
      ->type_name("WIDTHxHEIGHT");
  addChoice(command, "--background", look.picture.background, backgrounds, "Background of the picture (white)");
}

void addLookOptions(CLI::App& command, Look& look) {
  addText(command, "--view FILE.html", look.page, "Write a page for a browser");
  addPictureOptions(command, look);
}

void checkLook(const Look& look, const std::filesystem::path& out, const std::vector<NamedInput>& inputs) {
  checkFile("--png", look.png, {".png"}, out, inputs);
  checkFile("--view", look.page, {".html", ".htm"}, out, inputs);
  if (isSameFile(look.png, look.page))
    throw tufted::InvalidInput("--png and --view are one file, " + look.png.string());
}

void checkField(const Look& look, const tufted::Geometry& geometry, std::vector<ShownField> fields, bool has_normals) {
  addFields(geometry, fields);
  for (const char* const axis : {"x", "y", "z"}) fields.push_back({axis});
  if (has_normals && (!geometry.is_mesh || geometry.normals.rows() > 0)) fields.push_back({"normal"});
  if (look.color == "none" || (look.color.empty() && !look.isWanted())) return;
  const std::vector<std::string> names = namesOf(fields);
  const std::ptrdiff_t found = look.color.empty() ? 0 : tufted::findField(names, look.color);
  if (found < 0) throw tufted::InvalidInput("--color " + noneOf(look.color, names));
  const ShownField& field = fields[static_cast<std::size_t>(found)];
  if (field.columns > 0 && look.column.value_or(0) >= field.columns)
    refuseColumn(*look.column, field.name, field.columns);
}

void lookFromSensor(const tufted::Geometry& geometry, Look& look) {
  tufted::Camera& camera = look.picture.camera;
  if (geometry.height <= 1 || camera.azimuth || camera.eye.norm() > 0 || camera.up.norm() > 0) return;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double count = 0;
  for (Eigen::Index i = 0; i < geometry.points.rows(); ++i) {
    if (!geometry.points.row(i).allFinite()) continue;
    middle += geometry.points.row(i).transpose();
    ++count;
  }
  if (count == 0) return;
  const std::array<double, 7>& pose = geometry.viewpoint;
  const Eigen::Quaterniond turn = Eigen::Quaterniond(pose[3], pose[4], pose[5], pose[6]).normalized();
  const Eigen::Vector3d eye = Eigen::Vector3d(pose[0], pose[1], pose[2]) - middle / count;
  if (!eye.allFinite() || !(eye.norm() > 0)) return;
  camera.eye = eye;
  camera.up = turn * -Eigen::Vector3d::UnitY();  // rows of an image are counted downwards
}

std::vector<tufted::WholeFile> prepareLook(const tufted::Scene& scene, const Look& look) {
  std::vector<tufted::WholeFile> files;
  if (!look.isWanted()) return files;
  const tufted::PictureOptions options = pictureOf(scene, look);
  if (!look.page.empty())
    files.push_back(tufted::preparePage(
        look.page, scene,
        {.field = options.field, .column = options.column, .color_map = options.color_map, .camera = options.camera}));
  if (!look.png.empty()) files.push_back(tufted::preparePicture(look.png, scene, options));
  return files;
}

void addPlaceField(const Look& look, tufted::Scene& scene) {
  std::string name = look.color;
  const bool is_bare =
      name.empty() && std::all_of(scene.fields.begin(), scene.fields.end(), [](const SceneField& field) {
        return field.name == "file_row";  // says nothing about the shape
      });
  if (is_bare) {
    int axis = 2;
    const Eigen::Vector3d& up = look.picture.camera.up;
    if (up.norm() > 0) up.cwiseAbs().maxCoeff(&axis);
    name = std::string(up[axis] < 0 ? "-" : "") + "xyz"[axis];
  }
  const auto is_named = [&](const SceneField& field) { return field.name == name; };
  if (std::any_of(scene.fields.begin(), scene.fields.end(), is_named)) return;
  SceneField field = placeField(name, scene);
  if (!field.name.empty()) scene.fields.insert(is_bare ? scene.fields.begin() : scene.fields.end(), std::move(field));
}

void colorCopies(const tufted::Scene& scene, const Look& look, tufted::Geometry& geometry) {
  if (look.color.empty() || look.color == "none" || scene.fields.empty()) return;
  const tufted::PictureOptions options = pictureOf(scene, look);
  const std::vector<std::array<std::uint8_t, 3>> colors = tufted::pointColors(scene, options);
  std::erase_if(geometry.fields, [](const tufted::Field& field) {
    return isOneOf(field.name, {"rgb", "rgba", "red", "green", "blue", "alpha", "quality"});
  });
  const char* const names[] = {"red", "green", "blue"};
  for (std::size_t k = 0; k < 3; ++k) {
    tufted::Field field = {names[k], tufted::FieldType::uint8, 1, {}};
    for (const auto& color : colors) field.bytes.push_back(static_cast<std::byte>(color[k]));
    geometry.fields.push_back(std::move(field));
  }
  const SceneField& shown = scene.fields[static_cast<std::size_t>(options.field)];
  if (shown.kind == FieldKind::color || shown.kind == FieldKind::direction) return;
  const bool is_length = shown.kind == FieldKind::vector || shown.kind == FieldKind::coordinates;
  tufted::Field quality = {"quality", tufted::FieldType::float32, 1, {}};
  quality.bytes.resize(sizeof(float) * static_cast<std::size_t>(shown.values.rows()));
  for (Eigen::Index i = 0; i < shown.values.rows(); ++i) {
    const auto value =
        static_cast<float>(is_length ? shown.values.row(i).stableNorm() : shown.values(i, options.column));
    std::memcpy(quality.bytes.data() + sizeof(float) * static_cast<std::size_t>(i), &value, sizeof value);
  }
  geometry.fields.push_back(std::move(quality));
}

void addLook(const Look& look, Summary& summary) {
  if (!look.page.empty()) summary.add("page", "%s", look.page.c_str());
  if (!look.png.empty()) summary.add("picture", "%s", look.png.c_str());
}
