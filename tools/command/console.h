#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "summary.h"

/// What a command says beside warnings and errors, which stderr has in any case.
struct Console {
  bool quiet = false;    ///< nothing, nor progress
  bool verbose = false;  ///< the summary with its details
  bool json = false;     ///< one JSON object on standard output in place of the summary
};

/// Adds -q, --quiet and --json, one of which may be given.
void addConsole(CLI::App& command, Console& console);
/// Adds -q, --json and -v, --verbose, for commands that have details.
void addVerboseConsole(CLI::App& command, Console& console);

/// Says what a run has done: the lines of the summary or, with --json, what report.json holds, with the members "out",
/// the folder, and "warnings".
/// @throws IoError when standard output cannot be written
void sayResults(const Console& console, const Summary& summary, const std::filesystem::path& out,
                const std::vector<std::string>& warnings);
