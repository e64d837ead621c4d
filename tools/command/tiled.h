#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>

#include "build.h"
#include "console.h"
#include "input.h"

/// The options of a build by tiles.
struct Tiled {
  double memory = 0;         ///< --memory, in bytes; 0: not given, the whole cloud is built at once
  std::string memory_text;   ///< --memory, as it was given
  bool keeps_noise = false;  ///< --keep-noise
};

/// Adds --memory and --keep-noise.
void addTiled(CLI::App& command, Tiled& tiled);

/// @throws CLI::ExcludesError if --memory is given with an option that tiles do not have
void checkTiled(const CLI::App& command, const Tiled& tiled);

/// Builds a cloud by tiles and writes L and M into `out`. @returns the exit code
int runTiled(const Tiled& tiled, Input& input, Build& build, const std::filesystem::path& out, const Console& console);
