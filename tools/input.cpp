#include "input.h"

#include <CLI/CLI.hpp>
#include <iostream>

#include "options.h"
#include "tufted/errors.h"

CLI::Option* addInput(CLI::App& command, Input& input) {
  CLI::Option* const file =
      command.add_option("FILE", input.file, "Points or mesh; - reads standard input, its format told by its content")
          ->required()
          ->check(notEmpty);
  addChoice(command, "--as", input.as, kinds, "Take a file that may be either as one of them");
  command.add_flag("--weld", input.weld, "Give the vertices of a mesh that coincide one number, meshes only");
  return file;
}

tufted::Geometry readInput(const Input& input, const tufted::Progress& progress) {
  std::ios::sync_with_stdio(false);  // std::cin then tells an error from the end
  tufted::Geometry geometry =
      input.isStandardInput() ? tufted::read(std::cin, input.name(), input.as, tufted::FileFormat::automatic, progress)
                              : tufted::read(input.file, input.as, tufted::FileFormat::automatic, progress);
  if (!input.weld) return geometry;
  if (!geometry.is_mesh)
    throw tufted::InvalidInput("--weld applies to meshes, and " + input.name() +
                               " holds a point cloud, whose coincident points are merged in any case");
  tufted::weld(geometry);
  return geometry;
}
