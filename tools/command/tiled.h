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
  bool keeps_noise = false;  ///< --keep-noise
};

/// Adds --memory, which excludes all options of the command that tiles do not have, and --keep-noise. To be called when
/// all others were added.
void addTiled(CLI::App& command, Tiled& tiled);

/// Builds a cloud by tiles and writes L and M into `out`. @returns the exit code
int runTiled(const Tiled& tiled, Input& input, Build& build, const std::filesystem::path& out, const Console& console);
