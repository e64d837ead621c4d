#include "tiled.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bytes.h"
#include "command.h"
#include "console.h"
#include "interrupt.h"
#include "options.h"
#include "output.h"
#include "progress_bar.h"
#include "summary.h"
#include "tufted/errors.h"
#include "tufted/io/tiles.h"
#include "warnings.h"

namespace {

/// Options that a build by tiles has.
const std::set<std::string> available = {"--help",  "--help-all", "--as",     "--where",     "--crop",    "--polygon",
                                         "--thin",  "--out",      "--preset", "--neighbors", "--threads", "--mollify",
                                         "--quiet", "--json",     "--memory", "--keep-noise"};

std::string megabytes(double bytes) {
  return numberText(bytes / 1e6) + " MB";
}

tufted::TileOptions optionsOf(const Tiled& tiled, const Build& build) {
  if (build.preset != tufted::Preset::clean && !tiled.keeps_noise)
    throw tufted::InvalidInput("--memory needs --preset clean or --keep-noise: preset " + presetName(build.preset) +
                               " moves noisy points, which tiles cannot do yet");
  tufted::TileOptions options;
  options.cloud.steps = tufted::cloudSteps(build.preset);
  options.cloud.steps.denoise = false;
  options.cloud.neighbors = build.cloud.neighbors;
  options.cloud.threads = build.cloud.threads;
  if (build.mollify) options.cloud.mollify = *build.mollify;
  return options;
}

}  // namespace

void addTiled(CLI::App& command, Tiled& tiled) {
  const auto set = [&tiled](std::size_t bytes, const std::string& text) {
    tiled.memory = static_cast<double>(bytes);
    tiled.memory_text = text;
  };
  CLI::Option* const memory =
      addBytes(command, "--memory", set,
               "Build the cloud by tiles that fit in this much memory, such as 4G; writes other files, see below");
  command.add_flag("--keep-noise", tiled.keeps_noise, "Do not move noisy points onto the surface; only with --memory")
      ->needs(memory);
}

void checkTiled(const CLI::App& command, const Tiled& tiled) {
  if (tiled.memory == 0) return;
  for (const CLI::Option* option : command.get_options())
    if (option->count() > 0 && option->get_name().starts_with("--") && available.count(option->get_name()) == 0)
      throw CLI::ExcludesError("--memory", option->get_name());
}

int runTiled(const Tiled& tiled, Input& input, Build& build, const std::filesystem::path& out, const Console& console) {
  const auto start = std::chrono::steady_clock::now();
  ProgressBar bar(console.quiet);
  const tufted::Progress progress = showOn(bar);
  tufted::TileOptions options = optionsOf(tiled, build);
  options.progress = progress;
  progress("read", 0);
  tufted::FileSource source = openInput(input, progress);
  if (interrupted()) throw tufted::Cancelled("cancelled");
  bar.follow(Plan({{"sort", 15, 6}, {"tiles", 65}}));  // CPU times of a terrain of a million points
  options.memory = tiled.memory - source.memory;
  std::vector<std::string> notes = std::move(source.notes);
  tufted::TileSourceText text;
  text.of = source.of;
  text.rows = std::move(source.rows);
  text.source = input.name();
  text.preset = presetName(build.preset);
  text.memory = tiled.memory_text;
  text.keep_noise = tiled.keeps_noise;
  if (input.chosen.of > 0)
    text.selection = input.chosen.json().dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  const std::string given = "--memory " + tiled.memory_text + ", of which reading takes " + megabytes(source.memory);
  const tufted::TileReport report =
      forOption(given, [&] { return tufted::writeLaplacianByTiles(out, source, options, text); });
  bar.clear();
  for (const std::string& line : tufted::warnings(report)) notes.push_back(input.name() + ": " + line);
  for (const std::string& note : notes) warn(bar, note);
  Summary summary;
  summary.add("file", "%s (cloud)", input.name().c_str());
  summary.add("points", "%lld, %lld take part", static_cast<long long>(report.points),
              static_cast<long long>(report.active));
  summary.add("tiles", "%d of at most %lld points, %.0f %% of them margin; %d more builds for parts of them",
              report.tiles, static_cast<long long>(report.most_points), 100 * report.margin / (1 + report.margin),
              report.builds - report.tiles);
  summary.add("area", "%.10g, the sum of M", report.area);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  addEnd(seconds.count(), out, summary);
  sayResults(console, summary, out, notes);
  return exit_done;
}
