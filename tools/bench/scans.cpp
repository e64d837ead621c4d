// tufted_scans: a table of how well builds treat clouds of scanners and noisy clouds, with marks to be met; all
// variants of the build are compared with the core on the same clouds. See --help.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/stage_clock.h"
#include "bench/scan_case.h"
#include "bench/scan_table.h"

namespace tufted::bench {
namespace {

/// All variants, by the names that marks use. Others are compared with the first one.
const std::vector<Variant>& variants() {
  static const std::vector<Variant> all{{"core", cloudOptions(Preset::clean)},
                                        {"scan", cloudOptions(Preset::scan)},
                                        {"lidar", cloudOptions(Preset::lidar)},
                                        {"image", cloudOptions(Preset::scan), Neighbors::image},
                                        {"rings", cloudOptions(Preset::lidar), Neighbors::rings}};
  return all;
}

struct Settings {
  int first_seed = 101;  ///< constants are chosen on smaller seeds
  int seeds = 5;
  std::string filter;
  std::string json;
  bool quick = false;
  std::vector<std::string> builds;  ///< variants besides the first one; empty: all

  bool asksFor(const Variant& variant) const {
    return builds.empty() || std::find(builds.begin(), builds.end(), variant.name) != builds.end();
  }
};

/// Shows a line on stderr if that is a terminal.
void showProgress(const std::string& line) {
  static const bool is_terminal = isatty(STDERR_FILENO) != 0;
  if (!is_terminal) return;
  std::fprintf(stderr, "\r%s\033[K", line.c_str());
  std::fflush(stderr);
}

/// Adds a measurement; NaN if it fails, such as a spectrum that does not converge.
template <class Measure>
void measureInto(Figures& figures, Measure measure) {
  const Stopwatch watch;
  try {
    figures.values.push_back(measure());
  } catch (const std::runtime_error&) {
    figures.values.push_back(shapes::unknown);
  }
  figures.seconds += watch.seconds();
}

/// The rows of a case whose names contain the filter.
std::vector<Row> rowsOf(const Case& c, const std::string& filter) {
  std::vector<Row> rows;
  for (const Metric& metric : c.metrics) {
    const std::string name = c.what + " / " + c.dataset + " / " + metric.name;
    if (name.find(filter) == std::string::npos) continue;
    rows.push_back({.what = c.what,
                    .dataset = c.dataset,
                    .metric = &metric,
                    .is_full_size = c.is_full_size,
                    .figures = {},
                    .yardstick = {}});
    rows.back().figures.resize(variants().size());
  }
  return rows;
}

std::vector<Row> measureCase(const Case& c, const Settings& settings) {
  std::vector<Row> rows = rowsOf(c, settings.filter);
  const int seeds = rows.empty() ? 0 : c.is_random ? settings.seeds : 1;
  for (int seed = settings.first_seed; seed < settings.first_seed + seeds; ++seed) {
    const std::string name = c.what + " / " + c.dataset + ", seed " + std::to_string(seed);
    showProgress(name);
    const Sample sample = c.make(seed);
    const Build core(sample, variants().front(), nullptr);
    for (std::size_t v = 0; v < variants().size(); ++v) {
      if (v > 0 && !(settings.asksFor(variants()[v]) && sample.has(variants()[v].neighbors))) continue;
      showProgress(name + ", " + variants()[v].name);
      std::optional<Build> other;
      if (v > 0) other.emplace(sample, variants()[v], &core);
      const Build& build = other ? *other : core;
      for (Row& row : rows) measureInto(row.figures[v], [&] { return row.metric->measure(build); });
    }
    for (Row& row : rows) {
      if (row.metric->yardstick.measure) {
        measureInto(row.yardstick, [&] { return row.metric->yardstick.measure(sample); });
      }
    }
  }
  showProgress("");
  return rows;
}

void run(const Settings& settings) {
  const Stopwatch watch;
  const std::vector<Case> cases = scanCases(settings.quick);
  std::vector<Row> rows;
  printHeader();
  for (const Case& c : cases) {
    for (Row& row : measureCase(c, settings)) {
      printRow(row, variants());
      rows.push_back(std::move(row));
    }
  }
  std::printf("\n");
  printSummary(rows, variants());
  std::printf("%.0f s\n", watch.seconds());
  if (settings.json.empty()) return;

  nlohmann::ordered_json json{{"first_seed", settings.first_seed},
                              {"seeds", settings.seeds},
                              {"quick", settings.quick},
                              {"seconds", watch.seconds()}};
  json["rows"] = nlohmann::ordered_json::array();
  for (const Row& row : rows) json["rows"].push_back(asJson(row, variants()));
  std::ofstream stream(settings.json);
  stream << json.dump(1) << "\n";
  if (!stream.flush()) throw std::runtime_error("cannot write " + settings.json);
}

}  // namespace
}  // namespace tufted::bench

int main(int argc, char** argv) {
  try {
    tufted::bench::Settings settings;
    CLI::App app("Measures the build on scans, noise, outliers, sheets and rims, with the marks it is meant to hold.");
    app.add_option("--seeds", settings.seeds, "samples per dataset")->check(CLI::Range(1, 1000))->capture_default_str();
    app.add_option("--first-seed", settings.first_seed,
                   "of the samples; constants of the library were chosen on 1 to 9")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    app.add_option("--filter", settings.filter, "only rows whose `what / dataset / metric` contains this");
    app.add_option("--builds", settings.builds, "only these besides the core: scan, lidar, image, rings")
        ->delimiter(',')
        ->check(CLI::IsMember({"scan", "lidar", "image", "rings"}));
    app.add_option("--json", settings.json, "write all figures to this file as well");
    app.add_flag("--quick", settings.quick, "a quarter of the points, coarser rooms, few marks");
    CLI11_PARSE(app, argc, argv);
    tufted::bench::run(settings);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tufted_scans: %s\n", error.what());
    return 1;
  }
  return 0;
}
