#include "look.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "options.h"
#include "point_options.h"
#include "suggestion.h"
#include "tufted/errors.h"
#include "tufted/view/color_map.h"
#include "tufted/view/colors.h"
#include "tufted/view/page.h"

namespace {

using tufted::FieldKind;
using tufted::SceneField;

const std::map<std::string, tufted::Background> backgrounds = {{"white", tufted::Background::white},
                                                               {"dark", tufted::Background::dark},
                                                               {"transparent", tufted::Background::transparent}};
const std::map<std::string, Eigen::Vector3d> axes = {
    {"x", Eigen::Vector3d::UnitX()},   {"y", Eigen::Vector3d::UnitY()},   {"z", Eigen::Vector3d::UnitZ()},
    {"-x", -Eigen::Vector3d::UnitX()}, {"-y", -Eigen::Vector3d::UnitY()}, {"-z", -Eigen::Vector3d::UnitZ()}};

/// WIDTHxHEIGHT; false where it is none.
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

std::string checkMap(const std::string& name) {
  const std::vector<std::string> known = tufted::colorMapNames();
  if (std::find(known.begin(), known.end(), name) != known.end()) return "";
  std::string all;
  for (const std::string& map : known) all += (all.empty() ? "" : "|") + map;
  return name + " is none of " + all + didYouMean(name, known);
}

void setCamera(const std::string& text, tufted::Camera& camera) {
  const std::vector<double> numbers = parseNumbers(text, "--camera");
  const bool valid = (numbers.size() == 2 || numbers.size() == 3) && std::abs(numbers[1]) <= 90 &&
                     std::isfinite(numbers[0]) && (numbers.size() == 2 || (numbers[2] > 0 && numbers[2] <= 1000));
  if (!valid)
    throw CLI::ValidationError("--camera",
                               text +
                                   " is not AZIMUTH,ELEVATION or AZIMUTH,ELEVATION,ZOOM: degrees, the elevation "
                                   "from -90 to 90, the zoom positive and at most 1000");
  camera.azimuth = numbers[0];
  camera.elevation = numbers[1];
  if (numbers.size() == 3) camera.zoom = numbers[2];
}

/// Refuses a file that cannot be written.
void checkFile(const std::string& option, const std::filesystem::path& file) {
  if (file.empty()) return;
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw tufted::InvalidInput(option + " " + file.string() + ": is a directory");
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, error))
    throw tufted::IoError(file.string() + ": cannot write: there is no directory " + folder.string());
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw tufted::IoError(file.string() + ": cannot write: no permission in " + folder.string());
}

Eigen::MatrixXd valuesOf(const tufted::Field& field, Eigen::Index rows) {
  Eigen::MatrixXd values(rows, field.count);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (int k = 0; k < field.count; ++k)
      values(i, k) = tufted::valueOf(field, static_cast<std::size_t>(i * field.count + k));
  return values;
}

/// Red, green and blue of a packed colour.
Eigen::MatrixXd unpacked(const tufted::Field& field, Eigen::Index rows) {
  Eigen::MatrixXd values(rows, 3);
  for (Eigen::Index i = 0; i < rows; ++i) {
    std::uint32_t packed = 0;
    std::memcpy(&packed, field.bytes.data() + 4 * i, 4);
    for (int k = 0; k < 3; ++k) values(i, k) = (packed >> (16 - 8 * k)) & 0xff;
  }
  return values;
}

bool isOneOf(const std::string& name, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What the fields of a file are called here: their names, and `color` for colours.
std::vector<std::string> namesOf(const tufted::Geometry& geometry) {
  std::vector<std::string> names;
  for (const tufted::Field& field : geometry.fields)
    names.push_back(isOneOf(field.name, {"rgb", "rgba", "red", "green", "blue"}) ? "color" : field.name);
  return names;
}

/// The names in `results` that are files of one array per point.
bool isShown(const std::string& name) {
  return !isOneOf(name, {"evals", "principal_directions", "frames", "measured_positions", "M", "status",
                         "representative", "components"});
}

int indexOf(const tufted::Scene& scene, const std::string& name) {
  if (name.empty()) return 0;
  if (name == "none") return -1;
  std::vector<std::string> known;
  for (const SceneField& field : scene.fields) {
    if (field.name == name) return static_cast<int>(known.size());
    known.push_back(field.name);
  }
  std::string all;
  for (const std::string& field : known) all += (all.empty() ? "" : ", ") + field;
  throw tufted::InvalidInput("--color " + name + " is none of " + all + didYouMean(name, known));
}

/// The first column whose values are not all the same, 0 where there is none: eigenvectors begin with constants.
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

/// The options of a picture, for the field that is asked for.
tufted::PictureOptions pictureOf(const tufted::Scene& scene, const Look& look) {
  tufted::PictureOptions options = look.picture;
  options.field = indexOf(scene, look.color);
  if (scene.fields.empty() || options.field < 0) return options;
  const SceneField& field = scene.fields[static_cast<std::size_t>(options.field)];
  const bool has_columns =
      field.kind != FieldKind::vector && field.kind != FieldKind::coordinates && field.kind != FieldKind::color;
  const Eigen::Index columns = has_columns ? field.values.cols() : 1;
  options.column = look.column.value_or(has_columns ? firstVarying(field.values) : 0);
  if (options.column >= columns)
    throw tufted::InvalidInput("--column " + std::to_string(options.column) + ": " + field.name + " has " +
                               std::to_string(columns) + (columns == 1 ? " column" : " columns") + ", counted from 0");
  return options;
}

}  // namespace

void addPictureOptions(CLI::App& command, Look& look) {
  command.add_option("--png", look.png, "A picture of the result")->check(notEmpty)->type_name("FILE.png");
  command.add_option("--color", look.color, "The field that is shown, see below, or none (the first)")
      ->check(notEmpty)
      ->type_name("FIELD");
  addNumber(command, "--column", look.column, 0, std::numeric_limits<int>::max(),
            "Its column, counted from 0 (the first that is not constant)")
      ->type_name("K");
  const auto set_map = [&look](const std::string& name) { look.picture.color_map = name; };
  command
      .add_option_function<std::string>("--colormap", set_map,
                                        "Its colours: viridis, cividis, magma, coolwarm, purple_green or labels "
                                        "(by what its values mean)")
      ->check(checkMap)
      ->type_name("NAME");
  const auto set_camera = [&look](const std::string& text) { setCamera(text, look.picture.camera); };
  command
      .add_option_function<std::string>("--camera", set_camera,
                                        "From where, in degrees around and above, and how near (chosen)")
      ->type_name("AZIMUTH,ELEVATION[,ZOOM]");
  addChoice(command, "--up", look.picture.camera.up, axes, "The axis that is up (chosen)");
  const auto set_size = [&look](const std::string& text) { parseSize(text, look.picture.width, look.picture.height); };
  command.add_option_function<std::string>("--size", set_size, "Size of the picture (1200x900)")
      ->check(checkSize)
      ->type_name("WIDTHxHEIGHT");
  addChoice(command, "--background", look.picture.background, backgrounds, "Background of the picture (white)");
}

void addLookOptions(CLI::App& command, Look& look) {
  command.add_option("--view", look.page, "A page for a browser that shows the result")
      ->check(notEmpty)
      ->type_name("FILE.html");
  addPictureOptions(command, look);
}

void checkLook(const Look& look) {
  checkFile("--png", look.png);
  checkFile("--view", look.page);
  if (!look.png.empty() && look.png == look.page)
    throw tufted::InvalidInput("--png and --view are one file, " + look.png.string());
}

void checkColor(const Look& look, const tufted::Geometry& geometry, const std::vector<std::string>& results) {
  if (look.color.empty() || look.color == "none") return;
  std::vector<std::string> known;
  for (const std::string& name : results)
    if (isShown(name)) known.push_back(name);
  for (const char* name : {"mass", "boundary", "component"}) known.emplace_back(name);
  for (const std::string& name : namesOf(geometry))
    if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
  if (std::find(known.begin(), known.end(), look.color) != known.end()) return;
  std::string all;
  for (const std::string& name : known) all += (all.empty() ? "" : ", ") + name;
  throw tufted::InvalidInput("--color " + look.color + " is none of " + all + didYouMean(look.color, known));
}

FieldKind kindOfResult(const std::string& name, Eigen::Index columns) {
  static const std::map<std::string, FieldKind> meanings = {
      {"evecs", FieldKind::diverging},      {"embedding", FieldKind::diverging}, {"curvature", FieldKind::diverging},
      {"green", FieldKind::diverging},      {"u", FieldKind::diverging},         {"distance", FieldKind::distance},
      {"labels", FieldKind::label},         {"label", FieldKind::label},         {"component", FieldKind::label},
      {"components", FieldKind::label},     {"boundary", FieldKind::label},      {"status", FieldKind::label},
      {"classification", FieldKind::label}, {"vectors", FieldKind::vector},      {"normals", FieldKind::vector},
      {"logmap", FieldKind::coordinates},   {"color", FieldKind::color},         {"mass", FieldKind::positive},
      {"hks", FieldKind::positive}};
  const auto kind = meanings.find(name);
  if (kind == meanings.end()) return FieldKind::scalar;
  const bool fits = (kind->second != FieldKind::vector && kind->second != FieldKind::color) || columns == 3;
  return fits && (kind->second != FieldKind::coordinates || columns == 2) ? kind->second : FieldKind::scalar;
}

SceneField boundaryField(Eigen::MatrixXd values) {
  values.array() -= 1;  // none is grey
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
    const bool is_packed = isOneOf(field.name, {"rgb", "rgba"}) && field.count == 1 &&
                           field.bytes.size() == 4 * static_cast<std::size_t>(n);
    if (is_packed) {
      color = unpacked(field, n);
    } else if (isOneOf(field.name, {"red", "green", "blue"})) {
      if (color.rows() != n) color = Eigen::MatrixXd::Zero(n, 3);
      const double scale = field.type == tufted::FieldType::uint16 ? 1.0 / 257 : 1;
      color.col(field.name == "red" ? 0 : field.name == "green" ? 1 : 2) = scale * valuesOf(field, n).col(0);
    } else if (field.count > 0) {
      fields.push_back({field.name, kindOfResult(field.name, field.count), valuesOf(field, n)});
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
  for (const tufted::ResultArray& array : arrays)
    if (isShown(array.name) && array.values.rows() == n && array.values.cols() > 0)
      scene.fields.push_back({array.name, kindOfResult(array.name, array.values.cols()), array.values});
  for (SceneField& field : scene.fields) {
    if (field.kind == FieldKind::label) continue;
    for (Eigen::Index i = 0; i < n && !laplacian.status.empty(); ++i) {
      const tufted::PointStatus status = laplacian.status[static_cast<std::size_t>(i)];
      if (status != tufted::PointStatus::active && status != tufted::PointStatus::coincident)
        field.values.row(i).setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  const auto has_part = [&](std::size_t size) { return n > 0 && static_cast<Eigen::Index>(size) == n; };
  if (has_part(static_cast<std::size_t>(laplacian.M.size()))) {
    Eigen::MatrixXd mass = laplacian.M;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!(mass(i, 0) > 0)) mass(i, 0) = std::numeric_limits<double>::quiet_NaN();
    scene.fields.push_back({"mass", FieldKind::positive, std::move(mass)});
  }
  if (has_part(laplacian.boundary.size())) {
    Eigen::MatrixXd boundary(n, 1);
    for (Eigen::Index i = 0; i < n; ++i)
      boundary(i, 0) = static_cast<double>(laplacian.boundary[static_cast<std::size_t>(i)]);
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
  camera.up = turn * -Eigen::Vector3d::UnitY();  // rows of an image run downwards
}

void show(const tufted::Scene& scene, const Look& look) {
  if (!look.isWanted()) return;
  const tufted::PictureOptions options = pictureOf(scene, look);
  if (!look.page.empty())
    tufted::writePage(
        look.page, scene,
        {.field = options.field, .column = options.column, .color_map = options.color_map, .camera = options.camera});
  if (!look.png.empty()) tufted::writePicture(look.png, scene, options);
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
  if (shown.kind == FieldKind::color) return;
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
