#include "input.h"

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>

#include "options.h"
#include "tufted/errors.h"
#include "tufted/memory.h"

CLI::Option* addInput(CLI::App& command, Input& input) {
  CLI::Option* const file =
      command
          .add_option(
              "FILE", input.file,
              "Point cloud or mesh, - for standard input; the extension, or else the content, decides the format")
          ->required()
          ->check(notEmpty);
  addChoice(command, "--as", input.as, kinds, "Read FILE as a point cloud or as a mesh (a mesh if FILE has faces)");
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

}  // namespace

namespace {

/// Bytes that this process may take, by the system and by the shell's `ulimit -v`.
double usableMemory() {
  rlimit limit = {};
  const bool is_known = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  const auto available = static_cast<double>(tufted::availableMemory());
  return is_known ? std::min(available, static_cast<double>(limit.rlim_cur)) : available;
}

}  // namespace

std::string memoryText(const Input& input, std::int64_t points, double bytes) {
  char text[200];
  std::snprintf(
      text, sizeof text,
      ": L and M of %lld points take %.3g GB of memory or more, and %.3g GB are available; thin the points, or "
      "cut the file into parts",
      static_cast<long long>(points), bytes / 1e9, usableMemory() / 1e9);
  return input.name() + text;
}

std::optional<tufted::FileHead> readInputHead(const Input& input) {
  return input.isStandardInput() ? std::nullopt : tufted::readHead(input.file, input.as);
}

void refuseTooMany(const Input& input) {
  const std::optional<tufted::FileHead> head = readInputHead(input);
  if (!head || head->faces > 0) return;
  const double needed = static_cast<double>(head->points) * least_build_bytes;
  if (needed > usableMemory()) throw tufted::FileTooLarge(memoryText(input, head->points, needed));
}

tufted::Geometry readInput(const Input& input, const tufted::Progress& progress) {
  tufted::Geometry geometry = readAny(input, progress);
  if (input.weld && !geometry.is_mesh)
    throw tufted::InvalidInput("--weld applies to meshes, and " + input.name() +
                               " holds a point cloud, whose coincident points are merged in any case");
  return geometry;
}

void addMerged(const tufted::Geometry& geometry, Summary& summary) {
  if (geometry.merged_vertices > 0)
    summary.add("merged", "%lld equal corners; indices and rows are those of points.ply",
                static_cast<long long>(geometry.merged_vertices));
}
