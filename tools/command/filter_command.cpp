#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "command.h"
#include "eigenpairs.h"
#include "extent.h"
#include "moved_points.h"
#include "operator.h"
#include "options.h"
#include "reports.h"
#include "signal_options.h"
#include "tufted/errors.h"
#include "tufted/interpolation.h"
#include "tufted/signatures.h"

namespace filter_command {
namespace {

constexpr const char* description =
    "Apply a low-pass filter to fields of the points, to other values, or to the positions.";

constexpr const char* footer =
    R"(Example:
  tufted filter scan.ply --positions --count 100 --out filtered

The filter keeps the means over the connected components and the first K eigenvectors, or with --wavelength W the
eigenvectors whose wavelength is at least W. The wavelength is 2 pi divided by the root of the eigenvalue, in the unit
of the points. A W that is longer than all waves, or too short for the spacing of the points, is refused. With --denoise
--positions filters the moved points, with --operator those of points.ply.

Files in DIR, which replace older ones when all are complete:
  filtered.npy  N values, N x c for c columns, or N x 3 positions, float64. Points that are not finite or isolated keep
                their values; coincident points have the values of their representative.
  points.ply    the points with the field filtered, float32; points.pcd with --format pcd. With --positions the points
                are the filtered ones, without normals.
  report.json   number of eigenvectors, the shortest wavelength, method, iterations, residual, seconds
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --out DIR` wrote.)";

struct Settings {
  OperatorSettings source;
  SignalOptions signals;
  bool positions = false;
  Eigenpairs pairs = {.count = 100};
  std::optional<double> wavelength;
  Eigen::MatrixXd values;

  std::vector<std::string> files() const { return {"filtered.npy"}; }
};

void check(Settings& settings, const Operator& source) {
  const bool has_signals = !settings.signals.fields.empty() || !settings.signals.values.empty();
  if (!settings.positions) {
    if (!has_signals)
      throw tufted::InvalidInput(
          "nothing to filter is given, must be exactly one of --field, --values and --positions");
    settings.values = readSignals(settings.signals, source);
    settings.source.shown = {{"filtered", settings.values.cols()}};
  } else {
    if (has_signals) throw tufted::InvalidInput("--positions excludes --field and --values");
    checkHasPoints(source);
    settings.source.shown = {{moved_points_field}};
  }
  if (!settings.wavelength || !settings.pairs.folder.empty()) checkPairs(settings.pairs, source);
  settings.source.stages = spectralStages(settings.pairs.count);
}

double waveOf(double eigenvalue) {
  return 2 * std::numbers::pi / std::sqrt(eigenvalue);
}

double eigenvalueOf(double wavelength) {
  return std::pow(2 * std::numbers::pi / wavelength, 2);
}

/// Keeps the eigenvectors of waves of at least this length.
/// @return whether shorter waves were removed, so that no longer one is missing
/// @throws InvalidInput if none is that long, because the result would be constant on each component
bool keepLongWaves(const Operator& source, double wavelength, tufted::Spectrum& spectrum) {
  const Eigen::Index had = spectrum.values.size();
  const Eigen::Index kept = (spectrum.values.array() <= eigenvalueOf(wavelength)).count();
  if (kept == 0 && had > 0)
    throw tufted::InvalidInput("--wavelength " + numberText(wavelength) + " is longer than the longest wave, " +
                               numberText(waveOf(spectrum.values[0])) + ": " + extentOf(source).text());
  spectrum.values.conservativeResize(kept);
  spectrum.vectors.conservativeResize(Eigen::NoChange, kept);
  return kept < had;
}

/// Computes the eigenvectors of waves of at least this length.
/// @throws InvalidInput as keepLongWaves(), and for a length below that of all eigenvectors
tufted::Spectrum longWaves(const Operator& source, double wavelength) {
  const tufted::Laplacian& laplacian = source.laplacian;
  tufted::SpectrumOptions options = source.spectrumOptions();
  options.null_space = false;
  const std::string name = "--wavelength " + numberText(wavelength);
  const double most = tufted::mostEigenpairs(laplacian, false);
  const double weyl = laplacian.M.sum() * eigenvalueOf(wavelength) / (4 * std::numbers::pi);  // about how many
  for (double count = 16 + 1.1 * weyl; weyl <= most && most >= 1; count *= 1.5) {
    tufted::Spectrum spectrum = tufted::spectrum(laplacian, static_cast<int>(std::min(count, most)), options);
    if (keepLongWaves(source, wavelength, spectrum)) return spectrum;
    if (count >= most) break;
  }
  throw tufted::InvalidInput(name + " is shorter than what " + std::to_string(source.points()) +
                             " points can tell, must be longer, or give --count: " + extentOf(source).text());
}

/// Reads the eigenvectors of waves of at least this length from a folder.
/// @throws InvalidInput as keepLongWaves(), and if the folder may lack some
tufted::Spectrum longWavesOfFolder(const Operator& source, double wavelength, const Eigenpairs& pairs) {
  tufted::Spectrum spectrum = readPositivePairs(pairs, source);
  const double shortest = spectrum.values.size() > 0 ? waveOf(spectrum.values.tail<1>()[0]) : 0;
  if (keepLongWaves(source, wavelength, spectrum)) return spectrum;
  throw tufted::InvalidInput("--wavelength " + numberText(wavelength) + ": the shortest wave in " +
                             pairs.folder.string() + " is " + numberText(shortest) +
                             ", write more by `tufted spectrum --count`");
}

Results compute(Settings& settings, Operator& source) {
  if (settings.positions) settings.values = source.startingPoints();
  requireFinite(settings.values, source);
  const tufted::Spectrum spectrum = !settings.wavelength ? positivePairs(settings.pairs, source)
                                    : settings.pairs.folder.empty()
                                        ? longWaves(source, *settings.wavelength)
                                        : longWavesOfFolder(source, *settings.wavelength, settings.pairs);
  const Eigen::MatrixXd means = tufted::componentMeans(source.laplacian, settings.values);
  Eigen::MatrixXd filtered = means + tufted::filterSignals(source.laplacian, spectrum, settings.values - means);
  const auto count = spectrum.values.size();
  const double shortest = count > 0 ? waveOf(spectrum.values[count - 1]) : 0;
  Results results;
  results.report = {{"eigenvectors", count}, {"shortest_wave", shortest}};
  results.summary.add("eigenvectors", "%lld, the shortest wave %.6g", static_cast<long long>(count), shortest);
  addReport(spectrum.report, results);
  if (settings.positions) {
    movePoints("filtered", filtered, source, results);
  } else {
    results.arrays = {{.name = "filtered", .values = std::move(filtered)}};
  }
  return results;
}

}  // namespace
}  // namespace filter_command

void addFilter(CLI::App& app, Run& run) {
  using namespace filter_command;
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "filter", description, footer, compute, check);
  addSignalOptions(*command, settings->signals, "Values to filter");
  command->add_flag("--positions", settings->positions, "Filter the positions of the points");
  CLI::Option* const count =
      addCount(*command, settings->pairs, "--count", 1,
               "Number of eigenvectors to keep beside the means of the components (100, or all if fewer)");
  addSpectrumFolder(*command, settings->pairs);
  addNumber(*command, "--wavelength", settings->wavelength, std::numeric_limits<double>::min(),
            std::numeric_limits<double>::max(),
            "Keep all waves of at least this length, in the unit of the points, instead of K")
      ->excludes(count)
      ->type_name("W");
}
