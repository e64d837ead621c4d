#include "input.h"

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <regex>
#include <system_error>

#include "options.h"
#include "point_options.h"
#include "tufted/errors.h"
#include "tufted/memory.h"

void addSelection(CLI::App& command, ChosenPoints& chosen) {
  command
      .add_option("--where", chosen.selection.where,
                  "Keep points whose fields satisfy this, such as 'classification=2,6', 'z=10..20' or "
                  "'return_number=number_of_returns'; may be repeated, all must hold; clouds only")
      ->allow_extra_args(false)  // the next word may be FILE
      ->type_name("CONDITION");
  addText(command, "--crop X0,Y0,Z0,X1,Y1,Z1", chosen.crop, "Keep points in this box, sides included; clouds only");
  // inputsOf() finds the file by the name TEXT.
  addText(command, "--polygon TEXT", chosen.polygon,
          "Keep points in a polygon in x and y: text file of its corners, lines X Y; clouds only");
  addNumber(command, "--thin SPACING", chosen.selection.thin, 1e-150, 1e150,
            "Then keep points of which no two are closer than this, in the unit of FILE; clouds only");
}

namespace {

/// The selection with the values of --crop and --polygon.
tufted::Selection selectionOf(const ChosenPoints& chosen) {
  tufted::Selection selection = chosen.selection;
  if (!chosen.crop.empty()) {
    const std::vector<double> box = parseNumbers(chosen.crop, "--crop");
    if (box.size() != 6) throw tufted::InvalidInput("--crop " + chosen.crop + " is not X0,Y0,Z0,X1,Y1,Z1");
    selection.crop.emplace(Eigen::Vector3d(box[0], box[1], box[2]), Eigen::Vector3d(box[3], box[4], box[5]));
  }
  if (chosen.polygon.empty()) return selection;
  for (const Row& row : readRows(chosen.polygon)) {
    if (row.numbers.size() != 2) throw tufted::IoError(row.name + ": is not X Y");
    selection.polygon.emplace_back(row.numbers[0], row.numbers[1]);
  }
  if (selection.polygon.empty()) throw tufted::IoError(chosen.polygon.string() + ": has no corners");
  return selection;
}

void choose(tufted::Geometry& geometry, Input& input, const tufted::Progress& progress) {
  const tufted::Selection selection = selectionOf(input.chosen);
  if (selection.isEmpty()) return tufted::removeFileRow(geometry);
  if (geometry.is_mesh)
    throw tufted::InvalidInput("--where, --crop, --polygon and --thin apply to point clouds, and " + input.name() +
                               " holds a mesh (--as cloud takes its vertices alone)");
  input.chosen.of = geometry.points.rows();
  std::vector<int> rows = tufted::select(geometry, selection, progress);
  input.chosen.kept = std::ssize(rows);
  if (geometry.height <= 1) input.chosen.rows = std::move(rows);
}

}  // namespace

int ChosenPoints::rowOf(int number) const {
  if (rows.empty()) return number;
  const auto row = std::lower_bound(rows.begin(), rows.end(), number);
  return row == rows.end() || *row != number ? -1 : static_cast<int>(row - rows.begin());
}

std::string ChosenPoints::inFile(const std::string& message) const {
  static const std::regex named("(^|[^-\\w])(point|seed|source) (\\d{1,9})(?![.\\w])");  // not the option --source 5
  std::string text;
  auto done = message.begin();
  for (std::sregex_iterator at(message.begin(), message.end(), named), end; !rows.empty() && at != end; ++at) {
    const auto row = std::stoul((*at)[3].str());
    text.append(done, (*at)[3].first) += std::to_string(row < rows.size() ? rows[row] : static_cast<int>(row));
    done = (*at)[3].second;
  }
  return text.append(done, message.end());
}

nlohmann::ordered_json ChosenPoints::json() const {
  nlohmann::ordered_json json = {{"points", of}, {"kept", kept}};
  if (!selection.where.empty()) json["where"] = selection.where;
  if (!crop.empty()) json["crop"] = crop;
  if (!polygon.empty()) json["polygon"] = polygon.string();
  if (selection.thin > 0) json["thin"] = selection.thin;
  return json;
}

CLI::Option* addInput(CLI::App& command, Input& input) {
  CLI::Option* const file =
      command
          .add_option(
              "FILE", input.file,
              "Point cloud or mesh, - for standard input; the extension, or else the content, decides the format")
          ->required()
          ->check(notEmpty);
  addChoice(command, "--as", input.as, kinds, "Read FILE as a point cloud or as a mesh (a mesh if FILE has faces)");
  addSelection(command, input.chosen);
  return file;
}

void addWeld(CLI::App& command, Input& input) {
  command.add_flag("--weld", input.weld,
                   "Join coincident vertices, each of which keeps its index and row; meshes only");
}

namespace {

tufted::Geometry readAny(const Input& input, const tufted::Progress& progress) {
  constexpr auto automatic = tufted::FileFormat::automatic;
  if (input.isStandardInput()) {
    std::ios::sync_with_stdio(false);  // without this std::cin cannot tell an error from the end
    return tufted::read(std::cin, input.name(), input.as, automatic, progress);
  }
  std::error_code error;
  if (!std::filesystem::is_fifo(input.file, error)) return tufted::read(input.file, input.as, automatic, progress);
  std::ifstream pipe(input.file, std::ios::binary);
  if (!pipe) throw tufted::IoError(input.name() + ": cannot be read");
  return tufted::read(pipe, input.name(), input.as, automatic, progress);
}

/// Bytes that this process may take, by the system and by the shell's `ulimit -v`.
double usableMemory() {
  rlimit limit = {};
  const bool is_known = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  const auto available = static_cast<double>(tufted::availableMemory());
  return is_known ? std::min(available, static_cast<double>(limit.rlim_cur)) : available;
}

}  // namespace

std::string memoryText(const Input& input, std::int64_t points, double bytes) {
  char text[300];
  std::snprintf(text, sizeof text,
                ": %lld points take %.3g GB of memory or more, and %.3g GB are available; thin the points "
                "(--thin), cut the file into parts (--crop), or build rows by tiles (`tufted laplacian --memory`)",
                static_cast<long long>(points), bytes / 1e9, usableMemory() / 1e9);
  return input.name() + text;
}

std::optional<tufted::FileHead> readInputHead(const Input& input) {
  return input.isStandardInput() ? std::nullopt : tufted::readHead(input.file, input.as);
}

void refuseTooMany(const Input& input, double bytes) {
  if (input.chosen.isAsked()) return;
  const std::optional<tufted::FileHead> head = readInputHead(input);
  // Missing pixels take less. A file of less than a byte for each point is damaged or well compressed; reading tells.
  if (!head || head->faces > 0 || head->geometry.height > 1) return;
  if (std::filesystem::file_size(input.file) < static_cast<std::uintmax_t>(head->points)) return;
  const double needed = static_cast<double>(head->points) * bytes;
  if (needed > usableMemory()) throw tufted::FileTooLarge(memoryText(input, head->points, needed));
}

tufted::FileSource openInput(Input& input, const tufted::Progress& progress) {
  const tufted::Selection selection = selectionOf(input.chosen);
  std::error_code error;
  const bool is_file = !input.isStandardInput() && std::filesystem::is_regular_file(input.file, error);
  tufted::FileSource source = is_file ? tufted::sourceOf(input.file, input.as, selection, progress)
                                      : sourceOf(readAny(input, progress), input.name(), selection, progress);
  if (selection.isEmpty()) return source;
  input.chosen.of = source.of;
  input.chosen.kept = source.kept;
  return source;
}

tufted::Geometry readInput(Input& input, const tufted::Progress& progress) {
  tufted::Geometry geometry = readAny(input, progress);
  if (input.weld && !geometry.is_mesh)
    throw tufted::InvalidInput("--weld applies to meshes, and " + input.name() +
                               " holds a point cloud, whose coincident points are merged in any case");
  choose(geometry, input, progress);
  return geometry;
}

void addMerged(const tufted::Geometry& geometry, const Input& input, Summary& summary) {
  if (geometry.merged_vertices > 0)
    summary.add("merged", "%lld equal corners; indices and rows are those of points.ply",
                static_cast<long long>(geometry.merged_vertices));
  const ChosenPoints& chosen = input.chosen;
  if (chosen.of > 0)
    summary.add("chosen", "%lld of %lld points%s", static_cast<long long>(chosen.kept),
                static_cast<long long>(chosen.of),
                chosen.rows.empty() ? "; the others are missing pixels" : "; file_row.npy has their rows in the file");
}
