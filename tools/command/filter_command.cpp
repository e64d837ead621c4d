#include <numbers>

#include "subcommand.h"
#include "tufted/interpolation.h"
#include "tufted/signatures.h"

namespace {

struct Filter : Subcommand {
  explicit Filter(CLI::App& app)
      : Subcommand(app, "filter",
                   "Apply a low-pass filter to fields of the points, to other values, or to the positions.", R"(Example:
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
  report.json   number of eigenvectors, the shortest wavelength, method, iterations, residual, seconds)") {
    addSignalOptions(command, signals, "Values to filter");
    command.add_flag("--positions", positions, "Filter the positions of the points");
    CLI::Option* const count =
        addCount(command, pairs, "--count", 1,
                 "Number of eigenvectors to keep beside the means of the components (100, or all if fewer)");
    addSpectrumFolder(command, pairs);
    addNumber(command, "--wavelength W", wavelength, std::numeric_limits<double>::min(),
              std::numeric_limits<double>::max(),
              "Keep all waves of at least this length, in the unit of the points, instead of K")
        ->excludes(count);
  }

  void check(const Operator& source) override {
    const bool has_signals = !signals.fields.empty() || !signals.values.empty();
    if (!positions) {
      if (!has_signals)
        throw tufted::InvalidInput(
            "nothing to filter is given, must be exactly one of --field, --values and --positions");
      values = readSignals(signals, source);
      shown = {{"filtered", values.cols()}};
    } else {
      if (has_signals) throw tufted::InvalidInput("--positions excludes --field and --values");
      checkHasPoints(source);
      shown = {{moved_points_field}};
    }
    if (!wavelength || !pairs.folder.empty()) checkPairs(pairs, source);
    stages = spectralStages(pairs.count);
  }

  static double waveOf(double eigenvalue) { return 2 * std::numbers::pi / std::sqrt(eigenvalue); }

  static double eigenvalueOf(double wavelength) { return std::pow(2 * std::numbers::pi / wavelength, 2); }

  /// Keeps the eigenvectors of waves of at least this length.
  /// @return whether shorter waves were removed, so that no longer one is missing
  /// @throws InvalidInput if none is that long, because the result would be constant on each component
  bool keepLongWaves(const Operator& source, tufted::Spectrum& spectrum) const {
    const Eigen::Index had = spectrum.values.size();
    const Eigen::Index kept = (spectrum.values.array() <= eigenvalueOf(*wavelength)).count();
    if (kept == 0 && had > 0)
      throw tufted::InvalidInput("--wavelength " + numberText(*wavelength) + " is longer than the longest wave, " +
                                 numberText(waveOf(spectrum.values[0])) + ": " + extentOf(source).text());
    spectrum.values.conservativeResize(kept);
    spectrum.vectors.conservativeResize(Eigen::NoChange, kept);
    return kept < had;
  }

  /// Computes the eigenvectors of waves of at least this length.
  /// @throws InvalidInput as keepLongWaves(), and for a length below that of all eigenvectors
  tufted::Spectrum longWaves(const Operator& source) const {
    const tufted::Laplacian& laplacian = source.laplacian;
    tufted::SpectrumOptions options = source.spectrumOptions();
    options.null_space = false;
    const double most = tufted::mostEigenpairs(laplacian, false);
    const double weyl = laplacian.M.sum() * eigenvalueOf(*wavelength) / (4 * std::numbers::pi);  // about how many
    for (double count = 16 + 1.1 * weyl; weyl <= most && most >= 1; count *= 1.5) {
      tufted::Spectrum spectrum = tufted::spectrum(laplacian, static_cast<int>(std::min(count, most)), options);
      if (keepLongWaves(source, spectrum)) return spectrum;
      if (count >= most) break;
    }
    throw tufted::InvalidInput("--wavelength " + numberText(*wavelength) + " is shorter than what " +
                               std::to_string(source.points()) +
                               " points can tell, must be longer, or give --count: " + extentOf(source).text());
  }

  /// Reads the eigenvectors of waves of at least this length from a folder.
  /// @throws InvalidInput as keepLongWaves(), and if the folder may lack some
  tufted::Spectrum longWavesOfFolder(const Operator& source) const {
    tufted::Spectrum spectrum = readPositivePairs(pairs, source);
    const double shortest = spectrum.values.size() > 0 ? waveOf(spectrum.values.tail<1>()[0]) : 0;
    if (keepLongWaves(source, spectrum)) return spectrum;
    throw tufted::InvalidInput("--wavelength " + numberText(*wavelength) + ": the shortest wave in " +
                               pairs.folder.string() + " is " + numberText(shortest) +
                               ", write more by `tufted spectrum --count`");
  }

  Results compute(Operator& source) override {
    if (positions) values = source.startingPoints();
    requireFinite(values, source);
    const tufted::Spectrum spectrum = !wavelength            ? positivePairs(pairs, source)
                                      : pairs.folder.empty() ? longWaves(source)
                                                             : longWavesOfFolder(source);
    const Eigen::MatrixXd means = tufted::componentMeans(source.laplacian, values);
    Eigen::MatrixXd filtered = means + tufted::filterSignals(source.laplacian, spectrum, values - means);
    const auto count = spectrum.values.size();
    const double shortest = count > 0 ? waveOf(spectrum.values[count - 1]) : 0;
    Results results;
    results.report = {{"eigenvectors", count}, {"shortest_wave", shortest}};
    results.summary.add("eigenvectors", "%lld, the shortest wave %.6g", static_cast<long long>(count), shortest);
    addReport(spectrum.report, results);
    if (positions) {
      movePoints("filtered", filtered, source, results);
    } else {
      results.arrays = {{.name = "filtered", .values = std::move(filtered)}};
    }
    return results;
  }

  SignalOptions signals;
  bool positions = false;
  Eigenpairs pairs = {.count = 100};
  std::optional<double> wavelength;
  Eigen::MatrixXd values;

  std::vector<std::string> files() const override { return {"filtered.npy"}; }
};

}  // namespace

void addFilter(CLI::App& app, Run& run) {
  addSubcommand<Filter>(app, run);
}
