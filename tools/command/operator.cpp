#include "operator.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "bytes.h"
#include "console.h"
#include "interrupt.h"
#include "options.h"
#include "output.h"
#include "progress_bar.h"
#include "scene_fields.h"
#include "tufted/errors.h"
#include "tufted/version.h"
#include "warnings.h"

namespace {

const std::map<std::string, tufted::SolverMethod> methods = {{"automatic", tufted::SolverMethod::automatic},
                                                             {"cholesky", tufted::SolverMethod::cholesky},
                                                             {"multigrid", tufted::SolverMethod::multigrid}};

void addSolvingOptions(CLI::App& command, Solving& solving) {
  addChoice(
      command, "--solver", solving.method, methods,
      "How linear systems are solved; SolverMethod in messages (automatic: cholesky if its factor fits into memory)");
  addBytes(
      command, "--memory-limit", [&solving](std::size_t bytes, const std::string&) { solving.memory_limit = bytes; },
      "Memory for Cholesky factors, such as 500MB or 2GiB; memory_limit in messages (half of the available memory)");
}

void readFolder(const OperatorSettings& settings, Operator& source) {
  const std::filesystem::path& folder = settings.folder;
  source.laplacian = tufted::readLaplacian(folder, settings.needsCover(false));
  if (settings.needsCover(source.laplacian.kind == tufted::Kind::mesh) && !source.laplacian.hasCover())
    throw tufted::IoError(folder.string() + ": has no cover.npz, which `tufted laplacian --format npz,ply,cover` " +
                          "writes and " + settings.command.get_name() + " needs");
  source.geometry = tufted::readPoints(folder, source.progress);
  const auto n = static_cast<Eigen::Index>(source.laplacian.status.size());
  if (source.geometry.points.rows() != n && source.geometry.points.rows() > 0)
    throw tufted::IoError(folder.string() + ": the points are " + std::to_string(source.geometry.points.rows()) +
                          ", and L has " + std::to_string(n) + " rows");
}

/// The scene of a look: the results on the points, which the command may have moved.
tufted::Scene shownScene(const OperatorSettings& settings, const Operator& source, const Results& results) {
  const std::string title = settings.command.get_name() + ": " + std::filesystem::path(source.name).filename().string();
  return sceneOf(title, source.geometry, source.laplacian, results.shown.empty() ? results.arrays : results.shown);
}

/// The fields that the results become.
std::vector<ShownField> fieldsOf(const OperatorSettings& settings, const std::vector<std::string>& files) {
  std::vector<ShownField> fields = settings.shown;
  if (fields.empty())
    for (const std::filesystem::path file : files)
      if (file.extension() == ".npy" && isShown(file.stem().string())) fields.push_back({file.stem().string()});
  return fields;
}

void write(const OperatorSettings& settings, const Operator& source, const Results& results) {
  nlohmann::ordered_json json = {
      {"tufted", TUFTED_VERSION}, {"command", settings.command.get_name()}, {"source", source.name}};
  if (source.chosen.of > 0) json["selection"] = source.chosen.json();
  json.update(results.report);
  const tufted::Report& built = source.laplacian.report;
  if (settings.folder.empty() && built.neighbors > 0)  // a cloud
    json["build"] = {{"neighbors", built.neighbors},
                     {"neighbors_clamped", built.neighbors_clamped},
                     {"structure", nameOf(settings.build.structure)},
                     {"denoised", built.denoised},
                     {"noise", built.noise}};
  tufted::ResultOptions options = {.copies = settings.copies, .progress = source.progress, .lines = results.lines};
  options.report = textOf(json);
  if (source.geometry.points.rows() == 0 && source.points() > 0) options.copies.clear();
  if (results.write)
    results.write(settings.out, options);
  else
    tufted::writeResults(settings.out, source.laplacian, source.geometry, results.arrays, options);
}

/// Explains why nothing can be computed if no point is active; otherwise an empty string.
std::string whyNothing(const Operator& source) {
  const bool is_built = !source.laplacian.status.empty() || source.points() == 0;
  return is_built ? nothingActive(source.laplacian) : "";
}

/// Runs a step of a command. Messages name points by their rows in the file.
/// @throws IoError instead of InvalidInput if no point is active, because then the data is at fault and not the command
/// line
template <class Step>
auto blameData(const Operator& source, const Step& step) {
  try {
    return step();
  } catch (const tufted::InvalidInput& error) {
    const std::string why = whyNothing(source), message = source.chosen.inFile(error.what());
    if (why.empty()) throw tufted::InvalidInput(message);
    throw tufted::IoError(source.name + ": " + why + ": " + message);
  } catch (const tufted::SolverFailure& error) {
    throw tufted::SolverFailure(source.chosen.inFile(error.what()));
  }
}

}  // namespace

Subcommand::Subcommand(CLI::App& app, const char* name, const char* description, const std::string& footer,
                       const std::string& written)
    : OperatorSettings(*app.add_subcommand(name, description)) {
  command.footer(footer +
                 "\n`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M "
                 "that\n`tufted laplacian " +
                 written);
  CLI::Option* const file = addInput(command, input)->required(false);
  addWeld(command, input);
  CLI::Option* const folder_option =
      addText(command, "--operator DIR", folder,
              "Read L and M that `tufted laplacian --out DIR` wrote, instead of building them from FILE");
  addOut(command, out);
  addCopies(command, copies);
  command.option_defaults()->group("Building the Laplacian");
  addBuildOptions(command, build);
  command.option_defaults()->group("Linear systems and connected components");
  addSolvingOptions(command, solving);
  addComponentOptions(command, components);
  command.option_defaults()->group("Picture and page of the result");
  addLookOptions(command, look);
  addVerboseConsole(command, console);
  command.option_defaults()->group("Options");  // the group of the subcommand's own options, listed first
  std::vector<const CLI::Option*> unused;
  for (const char* const of_file : {"--as", "--weld", "--where", "--crop", "--polygon", "--thin"})
    unused.push_back(command.get_option(of_file));
  unused.insert(unused.end(), build.building.begin(), build.building.end());
  command.parse_complete_callback([this, file, folder_option, unused] {
    inputs = inputsOf(command);
    if (file->count() + folder_option->count() != 1) throw CLI::RequiredError("exactly one of FILE and --operator");
    checkSeed(build);
    if (folder_option->count() == 0) return;
    for (const CLI::Option* option : unused)
      if (option->count() > 0) throw CLI::ExcludesError(option->get_name(), "--operator");
  });
}

int Subcommand::run() {
  const auto start = std::chrono::steady_clock::now();
  ProgressBar bar(console.quiet);
  Operator source;
  source.name = name();
  source.solving = solving;
  source.threads = build.cloud.threads;
  source.up = look.picture.camera.up;
  source.progress = showOn(bar);
  const auto checkpoint = [] {
    if (interrupted()) throw tufted::Cancelled("cancelled");
  };
  source.progress("read", 0);
  std::vector<std::string> written = files();
  for (const std::string& copy : tufted::resultFiles({}, {.copies = copies})) written.push_back(copy);
  checkLook(look, out, inputs);
  checkOutput(inputs, out, written);
  if (folder.empty()) {
    refuseTooMany(input);
    source.geometry = readInput(input, source.progress);
  } else {
    readFolder(*this, source);
  }
  source.chosen = input.chosen;
  checkpoint();
  if (look.isWanted() && source.geometry.points.rows() == 0 && source.points() > 0)
    throw tufted::IoError(source.name + ": has no points to look at, which `tufted laplacian --format npz,ply` writes");
  blameData(source, [&] { check(source); });
  const bool moves = !shown.empty() && shown.front().name == moved_points_field;
  std::vector<ShownField> fields = fieldsOf(*this, written);
  requireLas(source.geometry, copies, source.name, fields);
  fields.insert(fields.end(), laplacian_fields.begin(), laplacian_fields.end());
  checkField(look, source.geometry, fields, !moves);
  bar.follow({source.geometry, stages});
  if (folder.empty())
    source.laplacian =
        buildLaplacian(source.geometry, input, build, needsCover(source.geometry.is_mesh), source.progress);
  source.moved = std::move(build.moved);
  checkpoint();
  std::vector<std::string> warnings =
      warningsOf(source.name, source.geometry, tufted::warnings(source.laplacian.report));
  Results chosen;
  chooseComponents(components, source, chosen);
  Results results = blameData(source, [&] { return compute(source); });
  if (!chosen.report.is_null()) results.report.update(chosen.report);
  writeAndShow(
      look, source.geometry, [&] { return shownScene(*this, source, results); },
      [&] { write(*this, source, results); });
  bar.clear();
  warnings.insert(warnings.end(), results.warnings.begin(), results.warnings.end());
  for (const std::string& warning : warnings) warn(bar, warning);
  Summary summary;
  addMerged(source.geometry, input, summary);
  summary.append(chosen.summary);
  summary.append(results.summary);
  addBuild(source.laplacian.report, build, summary);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  addEnd(seconds.count(), out, summary);
  addLook(look, summary);
  sayResults(console, summary, out, warnings);
  return exit_done;
}
