#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>
#include <vector>

/// Exit codes of the command.
enum ExitCode : int {
  exit_done = 0,
  exit_failed = 1,       ///< the data or the numerics are at fault
  exit_usage = 2,        ///< the command line is at fault
  exit_cancelled = 130,  ///< Ctrl-C, SIGTERM or SIGHUP; as shells report Ctrl-C
};

/// Set by the subcommand that the command line names: does its work, and returns an exit code or throws. Each function
/// below adds a subcommand.
using Run = std::function<int()>;

void addLaplacian(CLI::App& app, Run& run);
void addSpectrum(CLI::App& app, Run& run);
void addHks(CLI::App& app, Run& run);
void addEmbed(CLI::App& app, Run& run);
void addFilter(CLI::App& app, Run& run);
void addDistance(CLI::App& app, Run& run);
void addTrace(CLI::App& app, Run& run);
void addIsolines(CLI::App& app, Run& run);
void addSignedDistance(CLI::App& app, Run& run);
void addPath(CLI::App& app, Run& run);
void addInterpolate(CLI::App& app, Run& run);
void addPoisson(CLI::App& app, Run& run);
void addGreen(CLI::App& app, Run& run);
void addCurvature(CLI::App& app, Run& run);
void addExtend(CLI::App& app, Run& run);
void addTransport(CLI::App& app, Run& run);
void addLogmap(CLI::App& app, Run& run);
void addParameterize(CLI::App& app, Run& run);
void addDenoise(CLI::App& app, Run& run);
void addSmooth(CLI::App& app, Run& run);
void addMap(CLI::App& app, Run& run);
void addMinimal(CLI::App& app, Run& run);
void addDeform(CLI::App& app, Run& run);
void addWeights(CLI::App& app, Run& run);
void addSegment(CLI::App& app, Run& run);
void addNormals(CLI::App& app, Run& run);
void addOperators(CLI::App& app, Run& run);
void addInfo(CLI::App& app, Run& run);
void addValidate(CLI::App& app, Run& run);
void addView(CLI::App& app, Run& run);

/// Prefixes "./" to paths like "[a,b]" of validate, which CLI11 would parse as a list. validate removes the prefix
/// again.
void protectBrackets(std::vector<std::string>& arguments);
