#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "command.h"
#include "eigenpairs.h"
#include "extent.h"
#include "operator.h"
#include "options.h"
#include "point_options.h"
#include "reports.h"
#include "tufted/errors.h"
#include "tufted/signatures.h"

namespace hks_command {
namespace {

constexpr const char* description =
    "Compute heat kernel signatures of every point, or with --wave wave kernel signatures.";

constexpr const char* footer =
    R"(Example:
  tufted hks scan.ply --out hks

The signatures, in 1 / length^2, are computed from the K smallest positive eigenvalues lambda_i with their eigenvectors
phi_i, and from the constants on connected components.
  heat  sum of exp(-lambda_i t) phi_i(x)^2 at S times t from 4 ln 10 / lambda_K to 4 ln 10 / lambda_1, or at --times. A
        time is refused if heat has not left its point by then, or is already evenly distributed.
  wave  weighted means of phi_i(x)^2 around S energies from log lambda_1 to log lambda_K, or within --energies

These ranges differ by shape. To compare two shapes give the second one the times of the first, times the ratio of their
areas, or the first and last energy of the first, less the logarithm of this ratio.

Files in DIR, which replace older ones when all are complete:
  hks.npy      N x S, float64 (wks.npy with --wave); 0 at points that take no part, at coincident points as at their
               representative
  times.npy    S times in length^2 (energies.npy with --wave)
  evals.npy    the K eigenvalues that were used
  points.ply   the points with the fields hks_0, hks_1, ..., float32; points.pcd with --format pcd: one field hks of S
               values
  report.json  method, iterations, residual, seconds
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --out DIR` wrote.)";

struct Settings {
  OperatorSettings source;
  Eigenpairs pairs = {.count = 100};
  int samples = 0;  ///< 0: the default, 16 times or 100 energies
  bool wave = false;
  std::vector<double> times;
  std::string energies;
  std::vector<double> range;  ///< of `energies`, or empty

  int samplesOrDefault() const { return samples > 0 ? samples : wave ? 100 : 16; }
  std::vector<std::string> files() const {
    return {wave ? "wks.npy" : "hks.npy", wave ? "energies.npy" : "times.npy", "evals.npy"};
  }
};

/// Parses a time; nullopt unless it is finite and above 0.
std::optional<double> parseTime(const std::string& text) {
  double time = 0;
  const char* const text_end = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), text_end, time);
  const bool is_number = error == std::errc() && end == text_end;
  return is_number && time > 0 && std::isfinite(time) ? std::optional(time) : std::nullopt;
}

std::string isTime(const std::string& text) {
  return parseTime(text) ? "" : text + " is no time, must be finite and above 0";
}

void check(Settings& settings, const Operator& source) {
  checkPairs(settings.pairs, source);
  if (!settings.energies.empty()) {
    settings.range = parseNumbers(settings.energies, "--energies");
    if (settings.range.size() != 2 || !(settings.range[0] < settings.range[1]) || !std::isfinite(settings.range[1]))
      throw tufted::InvalidInput("--energies " + settings.energies +
                                 " is no FIRST,LAST, must be two ascending numbers");
  }
  settings.source.stages = spectralStages(settings.pairs.count);
  const auto times = settings.times.empty() ? settings.samplesOrDefault() : static_cast<int>(settings.times.size());
  settings.source.shown = {{settings.wave ? "wks" : "hks", times}};
}

/// Refuses times in which heat does not reach the next point, for which a few eigenvalues do not suffice, and times
/// after which it is constant up to rounding. In a time t heat spreads as far as the root of t.
void checkTimes(const std::vector<double>& times, const tufted::Spectrum& spectrum, const Operator& source) {
  const double* const end = spectrum.values.data() + spectrum.values.size();
  const double* const smallest = std::upper_bound(spectrum.values.data(), end, 0.0);
  const double even = smallest == end ? INFINITY : -std::log(std::numeric_limits<double>::epsilon()) / *smallest;
  const Extent extent = extentOf(source);
  for (const double time : times) {
    const bool is_short = std::sqrt(time) < extent.spacing;
    if (!is_short && time <= even) continue;
    throw tufted::InvalidInput(
        "--times " + numberText(time) + ": heat goes " + numberText(std::sqrt(time)) +
        (is_short ? ", not to the next point: " : ", and after " + numberText(even) + " it is even: ") + extent.text());
  }
}

/// The signature, and its times or energies.
std::vector<tufted::ResultArray> signatures(const Settings& settings, const tufted::Laplacian& laplacian,
                                            const tufted::Spectrum& spectrum) {
  if (settings.wave) {
    const int count = settings.samplesOrDefault();
    const tufted::VectorXd energies = settings.range.empty()
                                          ? tufted::waveEnergies(spectrum, count)
                                          : tufted::VectorXd::LinSpaced(count, settings.range[0], settings.range[1]);
    return {{.name = "wks",
             .values = settings.range.empty()
                           ? tufted::waveKernelSignature(spectrum, count)
                           : tufted::waveKernelSignature(spectrum, energies, 7 * (energies[1] - energies[0]))},
            {.name = "energies", .values = energies, .per_point = false}};
  }
  tufted::VectorXd times = Eigen::Map<const tufted::VectorXd>(settings.times.data(), std::ssize(settings.times));
  if (settings.times.empty()) times = tufted::heatTimes(spectrum, settings.samplesOrDefault());
  return {{.name = "hks", .values = tufted::heatKernelSignature(laplacian, spectrum, times)},
          {.name = "times", .values = times, .per_point = false}};
}

Results compute(Settings& settings, Operator& source) {
  const tufted::Spectrum spectrum = positivePairs(settings.pairs, source);
  checkTimes(settings.times, spectrum, source);
  Results results;
  results.arrays = signatures(settings, source.laplacian, spectrum);
  results.summary.add(settings.wave ? "energies" : "times", "%ld per point, of %ld eigenvalues up to %.6g",
                      static_cast<long>(results.arrays[0].values.cols()), static_cast<long>(spectrum.values.size()),
                      spectrum.values[spectrum.values.size() - 1]);
  addNullSpace(nullSpace(source.laplacian), false, results);
  results.arrays.push_back({.name = "evals", .values = spectrum.values, .per_point = false});
  addReport(spectrum.report, results);
  return results;
}

}  // namespace
}  // namespace hks_command

void addHks(CLI::App& app, Run& run) {
  using namespace hks_command;
  const auto [command, settings] = addOperatorCommand<Settings>(app, run, "hks", description, footer, compute, check);
  addCount(*command, settings->pairs, "--count", 2, "Number of positive eigenvalues to use (100, or all if fewer)");
  addSpectrumFolder(*command, settings->pairs);
  CLI::Option* const samples = addNumber(*command, "--samples", settings->samples, 2, 1 << 16,
                                         "Number of times (16), or with --wave of energies (100)")
                                   ->type_name("S");
  CLI::Option* const wave =
      command->add_flag("--wave", settings->wave, "Compute wave kernel signatures instead of heat kernel signatures");
  std::vector<double>& times = settings->times;
  const auto set = [&times](const std::vector<std::string>& words) {
    times.clear();
    for (const std::string& word : words) times.push_back(parseTime(word).value());
  };
  addList(*command, "--times",
          "Times, separated by commas, in squared units of the points (chosen from the eigenvalues)", isTime, set)
      ->excludes(samples)
      ->excludes(wave)
      ->type_name("LIST");
  command
      ->add_option("--energies", settings->energies,
                   "With --wave: the first and the last energy, natural logarithms of eigenvalues (of the eigenvalues)")
      ->needs(wave)
      ->type_name("FIRST,LAST");
}
