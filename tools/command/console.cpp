#include "console.h"

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tufted/errors.h"

void addConsole(CLI::App& command, Console& console) {
  command.option_defaults()->group("Output on the console");
  CLI::Option* const quiet = command.add_flag("-q,--quiet", console.quiet, "Print warnings and errors only");
  command.add_flag("--json", console.json, "Print one JSON object instead of text")->excludes(quiet);
}

void addVerboseConsole(CLI::App& command, Console& console) {
  addConsole(command, console);
  command.add_flag("-v,--verbose", console.verbose, "Also print how linear systems were solved, and how accurately")
      ->excludes(command.get_option("--quiet"))
      ->excludes(command.get_option("--json"));
}

std::string textOf(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void print(const std::string& text) {
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw tufted::IoError("standard output: cannot be written");
}

void sayResults(const Console& console, const Summary& summary, const std::filesystem::path& out,
                const std::vector<std::string>& warnings) {
  if (console.quiet) return;
  std::string text = summary.text(console.verbose);
  if (console.json) {
    std::ifstream file(out / "report.json");
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(file, nullptr, false);
    if (json.is_discarded()) throw tufted::IoError((out / "report.json").string() + ": cannot be read again");
    json["out"] = out.string();
    json["warnings"] = warnings;
    text = textOf(json);
  }
  print(text);
}

double peakMemory() {
  constexpr double kilobytes = 1024;  // per MB
  // Not by getrusage(), whose peak includes that of the process that called exec().
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double peak = 0;
    if (word == "VmHWM:" && status >> peak) return peak / kilobytes;
  }
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / kilobytes;
}

void addEnd(double seconds, const std::filesystem::path& out, Summary& summary) {
  summary.add("took", "%.3g s, peak memory %.0f MB", seconds, peakMemory());
  summary.add("written to", "%s", out.c_str());
}
