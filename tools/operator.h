#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "build.h"
#include "input.h"
#include "tufted/io/results.h"
#include "tufted/laplacian.h"

// What the commands that use a Laplacian have in common: where it comes from and where results go.

/// The options of such a command.
struct OperatorSettings {
  Input input;                   ///< FILE; empty with --operator
  std::filesystem::path folder;  ///< of --operator
  std::filesystem::path out;
  Build build;
  std::vector<tufted::Format> copies = {tufted::Format::ply};

  /// As messages call the source.
  std::string name() const { return folder.empty() ? input.name() : folder.string(); }
  int threads() const { return build.cloud.threads; }
};

/// Adds FILE or --operator, --out, --format and the options of building; checks that they fit together.
/// @param with_folder whether a Laplacian from a folder will do, which has no cover
void addOperatorOptions(CLI::App& command, OperatorSettings& settings, bool with_folder = true);

/// A Laplacian, and the points it belongs to.
struct Operator {
  tufted::Laplacian laplacian;
  tufted::Geometry geometry;  ///< 0 points: a folder without points.ply and points.pcd
};

/// Reads FILE and builds, or reads the folder.
/// @param files that will be written, see checkOutput
Operator loadOperator(OperatorSettings& settings, const std::vector<std::string>& files, bool keep_cover,
                      const tufted::Progress& progress);

/// Writes the results, with copies of the points where there are points.
/// @param report members of report.json beside "tufted", "command" and "source": a JSON object as text
void writeOperatorResults(const OperatorSettings& settings, const std::string& command, const Operator& source,
                          const std::vector<tufted::ResultArray>& arrays, const std::string& report,
                          const tufted::Progress& progress);
