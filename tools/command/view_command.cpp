#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "command.h"
#include "console.h"
#include "input.h"
#include "look.h"
#include "options.h"
#include "progress_bar.h"
#include "scene_fields.h"
#include "suggestion.h"
#include "tufted/errors.h"
#include "tufted/version.h"
#include "warnings.h"

namespace view_command {
namespace {

constexpr const char* description = "Show results, or a file, in a page for a browser or in a picture.";

constexpr const char* footer =
    R"(Example:
  tufted view distance --png distance.png

WHAT is a folder that another subcommand has written, or a file of a point cloud or mesh. Of a folder the arrays with a
row per point are shown, results first; points.ply or points.pcd must be in it. Of a file its fields are shown, and its
colours as the field `color`. Without --out and --png the page of a folder is view.html in it, and that of a file is
beside the file, with `.html` added to its name.

The page is a single file that needs no network, for any browser with WebGL 2.)";

struct Settings {
  Input what;  ///< or a folder, in `file`
  std::vector<std::string> fields;
  Look look;
  std::vector<NamedInput> inputs;
  Console console;
};

using tufted::FieldKind;
using tufted::Scene;
using tufted::SceneField;

/// The order in which arrays of a folder are shown: 0 for results, 1 for what belongs to the Laplacian.
int orderOf(const std::string& name) {
  const char* const last[] = {"M", "boundary", "components", "status"};
  return std::find(std::begin(last), std::end(last), name) == std::end(last) ? 0 : 1;
}

/// Adds the path, if there is one, and the arrays with a row per point. These replace the fields of the same names in
/// the copy of the points.
/// @param names names of the files of the result
void addArrays(const std::filesystem::path& folder, const std::vector<std::string>& names, Scene& scene) {
  std::vector<std::filesystem::path> files;
  for (const std::string& name : names)
    if (const std::filesystem::path file = folder / name; file.extension() == ".npy") files.push_back(file);
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return std::pair(orderOf(a.stem().string()), a) < std::pair(orderOf(b.stem().string()), b);
  });
  std::vector<SceneField> fields;
  for (const std::filesystem::path& file : files) {
    const std::string name = file.stem().string();
    if (isOneOf(name, {"frames", "measured_positions", "representative", "filtered_positions", "file_row", "to_target",
                       "map", "corner_uv"}))
      continue;
    Eigen::MatrixXd values = tufted::readArray(file);
    if (name == "path") {
      if (values.cols() == 3) scene.path = values;
      continue;
    }
    if (values.rows() != scene.positions.rows() || values.cols() == 0) continue;
    const std::string shown = name == "M" ? "mass" : name == "components" ? "component" : name;
    const FieldKind kind = kindOfResult(shown, values.cols());
    std::vector<std::string> columns = columnNamesOf(shown, values.cols());
    if (name == "boundary")
      fields.push_back(boundaryField(std::move(values)));
    else
      fields.push_back({.name = shown, .kind = kind, .values = std::move(values), .column_names = std::move(columns)});
  }
  const auto is_copy = [&](const SceneField& field) {
    return std::any_of(fields.begin(), fields.end(), [&](const SceneField& array) {
      const std::string rest = field.name.substr(std::min(array.name.size(), field.name.size()));
      return field.name.rfind(array.name, 0) == 0 &&
             (rest.empty() || (rest[0] == '_' && rest.find_first_not_of("0123456789", 1) == std::string::npos));
    });
  };
  std::erase_if(scene.fields, is_copy);
  for (SceneField& field : scene.fields)
    if (field.name == "boundary") field = boundaryField(std::move(field.values));
  std::erase_if(scene.fields,
                [](const SceneField& field) { return field.name == "status" || field.name == "representative"; });
  scene.fields.insert(scene.fields.begin(), std::make_move_iterator(fields.begin()),
                      std::make_move_iterator(fields.end()));
}

Scene sceneOfPoints(const std::string& title, const tufted::Geometry& geometry) {
  Scene scene = {.title = title, .positions = geometry.points};
  if (geometry.is_mesh) scene.triangles = geometry.triangles;
  if (geometry.normals.rows() == geometry.points.rows()) scene.normals = geometry.normals;
  scene.fields = fieldsOf(geometry);
  return scene;
}

Scene sceneOfFolder(const std::filesystem::path& folder, tufted::Geometry& geometry, const tufted::Progress& progress) {
  const std::vector<std::string> files = tufted::filesOfResult(folder);
  const auto has = [&](const char* name) { return std::find(files.begin(), files.end(), name) != files.end(); };
  if (!has("points.ply") && !has("points.pcd") && !has("points.las"))
    throw tufted::IoError(folder.string() + ": has no points.ply, points.pcd or points.las, which --format writes");
  geometry = tufted::readPoints(folder, progress);
  std::ifstream file(folder / "report.json");
  const nlohmann::json report = nlohmann::json::parse(file, nullptr, false);
  const auto text = [&](const char* name, const char* none) {
    const nlohmann::json value = report.is_object() ? report.value(name, nlohmann::json()) : nlohmann::json();
    return value.is_string() ? value.get<std::string>() : none;
  };
  Scene scene = sceneOfPoints(
      text("command", "laplacian") + ": " + std::filesystem::path(text("source", "")).filename().string(), geometry);
  addArrays(folder, files, scene);
  if (scene.triangles.rows() == 0 && has("triangles.ply")) {
    const tufted::Geometry surface = tufted::read(folder / "triangles.ply");
    if (surface.points.rows() == scene.positions.rows()) scene.triangles = surface.triangles;
  }
  return scene;
}

/// Keeps only the named fields, in this order.
void choose(const std::vector<std::string>& names, Scene& scene) {
  if (names.empty()) return;
  const std::vector<std::string> known = namesOf(scene.fields);
  std::vector<SceneField> chosen;
  for (const std::string& name : names) {
    const std::ptrdiff_t at = tufted::findField(known, name);
    if (at < 0)
      throw tufted::InvalidInput("--field " + (known.empty() ? name + ": there are no fields" : noneOf(name, known)));
    chosen.push_back(scene.fields[static_cast<std::size_t>(at)]);
  }
  scene.fields = std::move(chosen);
}

long long finitePoints(const Scene& scene) {
  const auto rows = scene.positions.rowwise();
  return std::count_if(rows.begin(), rows.end(), [](const auto& position) { return position.allFinite(); });
}

int runView(Settings& settings) {
  Look& look = settings.look;
  const std::filesystem::path& what = settings.what.file;
  std::error_code error;
  const bool is_folder = std::filesystem::is_directory(what, error);
  if (!look.isWanted() && settings.what.isStandardInput())
    throw tufted::InvalidInput("view of standard input: neither --out nor --png is given, must be one of them");
  if (!look.isWanted()) look.page = is_folder ? (what / "view.html").string() : what.string() + ".html";
  if (is_folder && (settings.what.chosen.isAsked() || settings.what.as != tufted::ReadAs::automatic))
    throw tufted::InvalidInput("--as, --where, --crop, --polygon and --thin apply to a file, and " + what.string() +
                               " is a folder of results");
  checkLook(look, {}, settings.inputs);
  ProgressBar bar(settings.console.quiet);
  const tufted::Progress progress = showOn(bar);
  progress("read", 0);
  tufted::Geometry geometry;
  Scene scene;
  if (is_folder) {
    scene = sceneOfFolder(what, geometry, progress);
  } else {
    geometry = readInput(settings.what, progress);
    scene = sceneOfPoints(std::filesystem::path(settings.what.name()).filename().string(), geometry);
  }
  const long long finite = finitePoints(scene);
  if (finite == 0) throw tufted::IoError(settings.what.name() + ": has no finite point to look at");
  choose(settings.fields, scene);
  lookFromSensor(geometry, look);
  if (settings.fields.empty() || !look.color.empty()) addPlaceField(look, scene);
  bar.follow(Plan(PlannedStages()));
  progress("write", 0);
  for (tufted::WholeFile& file : prepareLook(scene, look)) file.giveName();
  bar.clear();
  for (const std::string& note : geometry.notes) warn(bar, note);
  Summary summary;
  const ChosenPoints& chosen = settings.what.chosen;
  summary.add("points", "%lld", finite);
  if (chosen.of > 0)
    summary.add("chosen", "%lld of %lld points", static_cast<long long>(chosen.kept),
                static_cast<long long>(chosen.of));
  if (finite < scene.positions.rows())
    summary.add("left out", "%lld, not finite", static_cast<long long>(scene.positions.rows()) - finite);
  if (scene.triangles.rows() > 0) summary.add("triangles", "%lld", static_cast<long long>(scene.triangles.rows()));
  const std::vector<std::string> names = namesOf(scene.fields);
  summary.add("fields", "%s", names.empty() ? "none" : joined(names).c_str());
  addLook(look, summary);
  if (settings.console.quiet) return exit_done;
  std::string text = summary.text(false);
  if (settings.console.json) {
    nlohmann::ordered_json json = {{"tufted", TUFTED_VERSION}, {"command", "view"}, {"source", settings.what.name()}};
    json["points"] = scene.positions.rows();
    json["triangles"] = scene.triangles.rows();
    json["fields"] = names;
    if (chosen.of > 0) json["selection"] = chosen.json();
    json["warnings"] = geometry.notes;
    if (!look.page.empty()) json["page"] = look.page.string();
    if (!look.png.empty()) json["picture"] = look.png.string();
    text = textOf(json);
  }
  print(text);
  return exit_done;
}

}  // namespace
}  // namespace view_command

void addView(CLI::App& app, Run& run) {
  using namespace view_command;
  CLI::App& command = *app.add_subcommand("view", description);
  command.footer(footer);
  const auto settings = std::make_shared<Settings>();
  command
      .add_option("WHAT", settings->what.file,
                  "Folder of results, or a file of a point cloud or mesh, - for standard input")
      ->required()
      ->check(notEmpty);
  addText(command, "--out,-o,--view FILE.html", settings->look.page,
          "Name of the page (without a picture view.html in the folder, or the name of the file with .html)");
  command
      .add_option("--field", settings->fields, "Show only this field; may be repeated, in the order of the page (all)")
      ->allow_extra_args(false)
      ->type_name("NAME");
  addChoice(command, "--as", settings->what.as, kinds, "Read a file as a point cloud or as a mesh");
  addSelection(command, settings->what.chosen);
  addPictureOptions(command, settings->look);
  addConsole(command, settings->console);
  command.callback([&run, &command, settings] {
    settings->inputs = inputsOf(command);
    run = [settings] { return runView(*settings); };
  });
}
