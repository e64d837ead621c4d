#include "input.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>

#include "options.h"
#include "tufted/errors.h"

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
