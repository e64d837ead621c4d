#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
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

/// A JSON text with a newline. Paths in it need not be UTF-8.
std::string textOf(const nlohmann::ordered_json& json);

/// Prints a text on standard output. @throws IoError when it cannot be written
void print(const std::string& text);

/// Prints the summary or, with --json, the content of report.json in `out` with the members "out" and "warnings".
/// @throws IoError as print()
void sayResults(const Console& console, const Summary& summary, const std::filesystem::path& out,
                const std::vector<std::string>& warnings);

/// Peak memory of this process in MB.
double peakMemory();

/// Adds how long a command took, its peak memory, and where the results are.
void addEnd(double seconds, const std::filesystem::path& out, Summary& summary);
