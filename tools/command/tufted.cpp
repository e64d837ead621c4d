#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "command_line.h"
#include "interrupt.h"
#include "tufted/errors.h"

namespace {

/// One line on stderr.
int fail(std::string message, int code) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::fprintf(stderr, "tufted: %s\n", message.c_str());
  return code;
}

int runCommand(const Run& run) {
  try {
    return run();
  } catch (const tufted::Cancelled&) {
    return fail("cancelled", exit_cancelled);
  } catch (const tufted::InvalidInput& error) {
    return fail(error.what(), exit_usage);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", exit_failed);
  } catch (const std::exception& error) {
    return fail(error.what(), exit_failed);
  }
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): without memory for the options there is nothing to be done
int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is an error of the write, not a crash
  catchInterrupt();
  CLI::App app("A Laplacian for point clouds and triangle meshes of any connectivity.", "tufted");
  app.set_version_flag("--version", "tufted " TUFTED_VERSION);
  app.require_subcommand(1);
  app.footer("Exit codes: 0 done, 1 data or numerics, 2 usage, 130 cancelled.");
  Run run;
  addLaplacian(app, run);
  addSpectrum(app, run);
  addHks(app, run);
  addEmbed(app, run);
  addFilter(app, run);
  addDistance(app, run);
  addInterpolate(app, run);
  addPoisson(app, run);
  addGreen(app, run);
  addExtend(app, run);
  addTransport(app, run);
  addLogmap(app, run);
  addSegment(app, run);
  addNormals(app, run);
  addCurvature(app, run);
  addOperators(app, run);
  addInfo(app, run);
  addValidate(app, run);
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  const auto refuse = [&](const std::string& error) { return fail(explainArguments(app, words, error), exit_usage); };
  if (isMisleading(app, words)) return refuse("");
  try {
    std::vector<std::string> arguments = words;
    protectBrackets(arguments);
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    app.parse(std::move(arguments));
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return refuse(error.what());
  }
  return runCommand(run);
}
