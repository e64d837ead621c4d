#include "operator.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "interrupt.h"
#include "options.h"
#include "output.h"
#include "tufted/errors.h"

namespace {

const std::map<std::string, std::vector<tufted::Format>> copies = {
    {"ply", {tufted::Format::ply}}, {"pcd", {tufted::Format::pcd}}, {"none", {}}};

/// The points that a former `tufted laplacian` wrote into its folder; none where it was told not to, whatever an
/// earlier one left there.
tufted::Geometry pointsOf(const std::filesystem::path& folder) {
  std::ifstream report(folder / "report.json");
  const nlohmann::json json = nlohmann::json::parse(report, nullptr, false);
  const auto files = json.value("/write_options/files"_json_pointer, nlohmann::json::array());
  for (const char* name : {"points.ply", "points.pcd"})
    if (std::find(files.begin(), files.end(), name) != files.end()) return tufted::read(folder / name);
  return {};
}

}  // namespace

void addOperatorOptions(CLI::App& command, OperatorSettings& settings, bool with_folder) {
  CLI::Option* const file = addInput(command, settings.input);
  if (with_folder) {
    file->required(false);
    CLI::Option* const folder =
        command
            .add_option("--operator", settings.folder,
                        "Take the Laplacian that `tufted laplacian --out DIR` wrote, instead of building FILE's")
            ->check(notEmpty)
            ->type_name("DIR");
    command.parse_complete_callback([file, folder, &settings] {
      if (file->count() + folder->count() != 1) throw CLI::RequiredError("exactly one of FILE and --operator");
      if (folder->count() == 0) return;
      std::vector<const CLI::Option*> unused = settings.build.cloud_only;
      unused.insert(unused.end(), settings.build.others.begin(), settings.build.others.end());
      for (const CLI::Option* option : unused)
        if (option->count() > 0) throw CLI::ExcludesError(option->get_name(), "--operator");
    });
  }
  addOut(command, settings.out);
  addChoice(command, "--format", settings.copies, copies, "Format of the copy of the points with the results (ply)");
  addBuildOptions(command, settings.build);
}

Operator loadOperator(OperatorSettings& settings, const std::vector<std::string>& files, bool keep_cover,
                      const tufted::Progress& progress) {
  progress("read", 0);
  Operator source;
  if (!settings.folder.empty()) {
    std::error_code error;
    if (std::filesystem::equivalent(settings.folder, settings.out, error))
      throw tufted::InvalidInput("--out " + settings.out.string() + ": is the folder of --operator, whose report and " +
                                 "points would be overwritten");
    checkOutput(settings.input, settings.out, files);
    source.laplacian = tufted::readLaplacian(settings.folder, keep_cover);
    source.geometry = pointsOf(settings.folder);
    const auto n = static_cast<Eigen::Index>(source.laplacian.status.size());
    if (source.geometry.points.rows() != n && source.geometry.points.rows() > 0)
      throw tufted::IoError(settings.folder.string() + ": the points are " +
                            std::to_string(source.geometry.points.rows()) + ", and L has " + std::to_string(n) +
                            " rows");
  } else {
    checkOutput(settings.input, settings.out, files);
    source.geometry = readInput(settings.input);
    if (interrupted()) throw tufted::Cancelled("cancelled");
    source.laplacian = buildLaplacian(source.geometry, settings.input, settings.build, keep_cover, progress);
  }
  if (interrupted()) throw tufted::Cancelled("cancelled");
  return source;
}

void writeOperatorResults(const OperatorSettings& settings, const std::string& command, const Operator& source,
                          const std::vector<tufted::ResultArray>& arrays, const std::string& report,
                          const tufted::Progress& progress) {
  nlohmann::ordered_json json = {{"tufted", TUFTED_VERSION}, {"command", command}, {"source", settings.name()}};
  json.update(nlohmann::ordered_json::parse(report));
  tufted::ResultOptions options;
  // A path need not be UTF-8.
  options.report = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  options.progress = progress;
  options.copies = settings.copies;
  if (source.geometry.points.rows() == 0 && !source.laplacian.status.empty()) options.copies.clear();
  tufted::writeResults(settings.out, source.laplacian, source.geometry, arrays, options);
}
