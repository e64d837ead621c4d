#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "command.h"
#include "operator.h"
#include "options.h"
#include "point_options.h"
#include "progress_bar.h"
#include "tufted/errors.h"
#include "tufted/interpolation.h"

namespace {

constexpr const char* description = "Carry values of some points over to all others.";

constexpr const char* footer =
    R"(Pins are given as INDEX=V or X,Y,Z=V (the point nearest to a position), with V1,V2,... for several values at once,
or in a text file of lines `INDEX V1 V2 ...`. Several at one place give their mean.
  harmonic    L u = 0 elsewhere: within the range of the pins, with peaks at them
  biharmonic  least bending: smooth at the pins, not bounded by them
Points that no path joins to a pin are NaN.

Writes into DIR, renamed one after the other when all are complete:
  values.npy   N values or N x c, float64
  points.ply   the points with the field values, float32; points.pcd with --format pcd
  report.json  iterations, residual, seconds
FILE and the options of building are those of `tufted laplacian`; --operator takes what that has written.)";

enum class Method { harmonic, biharmonic };
const std::map<std::string, Method> methods = {{"harmonic", Method::harmonic}, {"biharmonic", Method::biharmonic}};

struct Settings {
  OperatorSettings source;
  std::vector<std::string> pins;
  std::filesystem::path file;
  Method method = Method::harmonic;
};

/// A place, by index or position, and its values.
struct Pin {
  std::vector<double> place, values;
};

Pin parsePin(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw tufted::InvalidInput("--pin " + text + " is not INDEX=V or X,Y,Z=V");
  Pin pin{parseNumbers(text.substr(0, equals), "--pin"), parseNumbers(text.substr(equals + 1), "--pin")};
  if ((pin.place.size() != 1 && pin.place.size() != 3) || pin.values.empty())
    throw tufted::InvalidInput("--pin " + text + " is not INDEX=V or X,Y,Z=V");
  return pin;
}

std::vector<Pin> readPins(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw tufted::IoError(path.string() + ": cannot be read");
  std::vector<Pin> pins;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    std::istringstream words(line);
    Pin pin;
    bool are_numbers = true;
    for (std::string word; words >> word;) {
      double value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      are_numbers &= error == std::errc() && end == word.data() + word.size();
      (pin.place.empty() ? pin.place : pin.values).push_back(value);
    }
    if (pin.place.empty()) continue;  // a blank line
    if (!are_numbers || pin.values.empty())
      throw tufted::IoError(path.string() + ":" + std::to_string(number) + ": is not INDEX V1 V2 ...");
    pins.push_back(std::move(pin));
  }
  return pins;
}

tufted::Pins pinsOf(const Settings& settings, const Operator& source) {
  std::vector<Pin> given;
  if (!settings.file.empty()) given = readPins(settings.file);
  for (const std::string& text : settings.pins) given.push_back(parsePin(text));
  if (given.empty()) throw tufted::InvalidInput("no pin is given, must be at least one by --pin or --pins");
  const auto columns = given.front().values.size();
  tufted::Pins pins{{}, Eigen::MatrixXd(static_cast<Eigen::Index>(given.size()), static_cast<Eigen::Index>(columns))};
  for (std::size_t k = 0; k < given.size(); ++k) {
    const Pin& pin = given[k];
    if (pin.values.size() != columns)
      throw tufted::InvalidInput("pin " + std::to_string(k) + " has " + std::to_string(pin.values.size()) +
                                 " values, must have " + std::to_string(columns) + " as the first");
    if (pin.place.size() == 1 &&
        !(pin.place[0] >= 0 && pin.place[0] < 2e9 && pin.place[0] == static_cast<int>(pin.place[0])))
      throw tufted::InvalidInput("pin " + std::to_string(k) + " is at no index");
    pins.points.push_back(pin.place.size() == 1 ? static_cast<int>(pin.place[0])
                                                : nearestOf(source, {pin.place[0], pin.place[1], pin.place[2]}));
    for (std::size_t c = 0; c < columns; ++c)
      pins.values(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c)) = pin.values[c];
  }
  return pins;
}

int runInterpolate(Settings& settings) {
  ProgressBar bar;
  const tufted::Progress progress = showOn(bar);
  const Operator source =
      loadOperator(settings.source, {"values.npy", "points.ply", "points.pcd", "report.json"}, false, progress);
  const tufted::Pins pins = pinsOf(settings, source);
  const tufted::SolverOptions options = {.threads = settings.source.threads(), .progress = progress};
  tufted::SolveReport made;
  const bool harmonic = settings.method == Method::harmonic;
  Eigen::MatrixXd values = harmonic ? tufted::harmonic(source.laplacian, pins, options, &made)
                                    : tufted::biharmonic(source.laplacian, pins, options, &made);
  const long long unreached = values.col(0).array().isNaN().count();
  const nlohmann::ordered_json report = {
      {"method", harmonic ? "harmonic" : "biharmonic"},
      {"pins", pins.points.size()},
      {"report", {{"iterations", made.iterations}, {"residual", made.residual}, {"seconds", made.seconds}}}};
  writeOperatorResults(settings.source, "interpolate", source, {{.name = "values", .values = std::move(values)}},
                       report.dump(), progress);
  bar.clear();
  std::printf("%-15s %zu\n", "pins", pins.points.size());
  std::printf("%-15s %lld points, which are NaN\n", "not reached", unreached);
  std::printf("%-15s residual %.1e, %.3g s\n", "solve", made.residual, made.seconds);
  std::printf("%-15s %s\n", "written to", settings.source.out.c_str());
  if (std::fflush(stdout) != 0) throw tufted::IoError("standard output: cannot write the summary");
  return exit_done;
}

}  // namespace

void addInterpolate(CLI::App& app, Run& run) {
  CLI::App& command = *app.add_subcommand("interpolate", description);
  command.footer(footer);
  const auto settings = std::make_shared<Settings>();
  addOperatorOptions(command, settings->source);
  command.add_option("--pin", settings->pins, "A point and its value, may be repeated")
      ->allow_extra_args(false)
      ->type_name("INDEX=V|X,Y,Z=V");
  command.add_option("--pins", settings->file, "A text file of pins")->check(notEmpty)->type_name("FILE");
  addChoice(command, "--method", settings->method, methods, "Which function, see below (harmonic)");
  command.callback([&run, settings] { run = [=] { return runInterpolate(*settings); }; });
}
