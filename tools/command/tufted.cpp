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
#include "options.h"
#include "tufted/errors.h"
#include "version.h"

namespace {

/// Prints a message in one line on stderr, and returns `code`.
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
    return fail(withoutClass(error.what()), exit_usage);
  } catch (const std::bad_alloc&) {
    return fail(
        "out of memory: of a cloud, fewer points take less (--thin, --crop), and `tufted laplacian --memory` builds "
        "tiles",
        exit_failed);
  } catch (const std::exception& error) {
    return fail(error.what(), exit_failed);
  }
}

constexpr const char* examples =
    R"(Examples:
  tufted info scan.ply
  tufted laplacian scan.ply --out laplacian
  tufted distance scan.ply --source 0 --out distance

`tufted help SUBCOMMAND` explains a subcommand, with examples. L is the Laplacian, M the diagonal matrix of areas.
Formats that are read: PCD, PLY, LAS, text in columns, NPY, OBJ, OFF, STL and VTK.
Exit codes: 0 done, 1 the data or the numerics do not allow it, 2 the command line is wrong, 130 cancelled.)";

/// A purpose and the subcommands for it, in the order of the help.
struct Purpose {
  const char* name;
  std::vector<void (*)(CLI::App& app, Run& run)> add;
};

const Purpose purposes[] = {
    {"Look at files", {addInfo, addView, addValidate}},
    {"Matrices", {addLaplacian, addOperators}},
    {"Distances and directions along the surface",
     {addDistance, addPath, addTrace, addSignedDistance, addLogmap, addTransport}},
    {"Values on the surface", {addIsolines, addInterpolate, addExtend, addWeights, addPoisson, addGreen}},
    {"Frequencies", {addSpectrum, addHks, addEmbed, addFilter, addMap}},
    {"Shape", {addNormals, addCurvature, addSegment, addParameterize}},
    {"Moving the points", {addDenoise, addSmooth, addMinimal, addDeform}}};

void addSubcommands(CLI::App& app, Run& run) {
  const auto is_new = [](const CLI::App* command) { return command->get_group() == "Subcommands"; };
  for (const Purpose& purpose : purposes) {
    for (const auto add : purpose.add) add(app, run);
    for (CLI::App* const command : app.get_subcommands(is_new)) command->group(purpose.name);
  }
}

/// Replaces `tufted`, `tufted help` and `tufted help SUBCOMMAND` by calls with --help.
std::vector<std::string> withHelp(std::vector<std::string> words) {
  if (words.empty()) return {"--help"};
  if (words[0] != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): without memory for the options nothing can be done
int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // exceeding a file size limit is then an error of write(), not a crash
  catchInterrupt();
  CLI::App app("A Laplacian for point clouds and triangle meshes of any connectivity.", "tufted");
  app.set_version_flag("-V,--version", versionText(), "Print the version, licence and built-in libraries, and exit");
  app.require_subcommand(1);
  app.footer(examples);
  Run run;
  addSubcommands(app, run);
  const std::vector<std::string> words = withHelp({argv + std::min(argc, 1), argv + argc});
  const auto refuse = [&](const std::string& error) { return fail(explainArguments(app, words, error), exit_usage); };
  if (isMisleading(app, words)) return refuse("");
  try {
    std::vector<std::string> arguments = words;
    protectBrackets(arguments);
    std::reverse(arguments.begin(), arguments.end());  // CLI11 expects them in reverse
    app.parse(std::move(arguments));
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ExtrasError&) {  // its own text lists the words in reverse
    std::string rest;
    for (const std::string& word : app.remaining(true)) rest += " " + word;
    return refuse("not expected:" + rest);
  } catch (const CLI::ParseError& error) {
    return refuse(error.what());
  } catch (const tufted::InvalidInput& error) {  // thrown by functions that parse values
    return refuse(error.what());
  }
  return runCommand(run);
}
