#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "../command.h"
#include "files.h"
#include "tufted/io/read.h"

constexpr double most_seconds = 1e9;  // that a limit may have

/// What the process of one file is told.
struct FileSettings {
  tufted::ReadAs as = tufted::ReadAs::automatic;
  int threads = 1;
  double seconds = 600;       ///< limit, 0 for none
  std::optional<int> memory;  ///< limit in MB
};

/// The command line on which this program validates a file or the folder of an operator and writes what it found on
/// stdout, as a line of JSON.
std::vector<std::string> fileArguments(const Found& file, const FileSettings& settings);

/// The hidden subcommand that does so.
void addValidateFile(CLI::App& app, Run& run);
