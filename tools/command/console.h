#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "summary.h"

/// What a command prints in addition to warnings and errors, which always go to stderr.
struct Console {
  bool quiet = false;    ///< nothing, not even progress
  bool verbose = false;  ///< the summary with its details
  bool json = false;     ///< a JSON object on standard output instead of the summary
};

/// Adds --quiet and --json, which exclude each other.
void addConsole(CLI::App& command, Console& console);
/// Adds --quiet, --json and --verbose, for commands whose summary has details.
void addVerboseConsole(CLI::App& command, Console& console);

/// Prints the summary or, with --json, the content of report.json in `out` with the members "out" and "warnings".
/// @throws IoError when standard output cannot be written
void sayResults(const Console& console, const Summary& summary, const std::filesystem::path& out,
                const std::vector<std::string>& warnings);

/// Peak memory of this process in MB.
double peakMemory();
