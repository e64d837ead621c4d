#include <charconv>
#include <system_error>

#include "subcommand.h"
#include "tufted/signatures.h"

namespace {

struct Hks : Subcommand {
  explicit Hks(CLI::App& app)
      : Subcommand(app, "hks", "Compute heat kernel signatures of every point, or with --wave wave kernel signatures.",
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
  report.json  method, iterations, residual, seconds)") {
    addCount(command, pairs, "--count", 2, "Number of positive eigenvalues to use (100, or all if fewer)");
    addSpectrumFolder(command, pairs);
    CLI::Option* const samples_option = addNumber(command, "--samples S", samples, 2, 1 << 16,
                                                  "Number of times (16), or with --wave of energies (100)");
    CLI::Option* const wave_flag =
        command.add_flag("--wave", wave, "Compute wave kernel signatures instead of heat kernel signatures");
    const auto set = [this](const std::vector<std::string>& words) {
      times.clear();
      for (const std::string& word : words) times.push_back(parseTime(word).value());
    };
    addList(command, "--times",
            "Times, separated by commas, in squared units of the points (chosen from the eigenvalues)", isTime, set)
        ->excludes(samples_option)
        ->excludes(wave_flag)
        ->type_name("LIST");
    command
        .add_option(
            "--energies", energies,
            "With --wave: the first and the last energy, natural logarithms of eigenvalues (of the eigenvalues)")
        ->needs(wave_flag)
        ->check(notEmpty)
        ->type_name("FIRST,LAST");
  }

  /// Parses a time; nullopt unless it is finite and above 0.
  static std::optional<double> parseTime(const std::string& text) {
    double time = 0;
    return parseNumber(text, time) && time > 0 && std::isfinite(time) ? std::optional(time) : std::nullopt;
  }

  static std::string isTime(const std::string& text) {
    return parseTime(text) ? "" : text + " is no time, must be finite and above 0";
  }

  void check(const Operator& source) override {
    checkPairs(pairs, source);
    if (!energies.empty()) {
      range = parseNumbers(energies, "--energies");
      const double width = range.size() == 2 ? (range[1] - range[0]) / samplesOrDefault() : 0;
      if (!(width > 0) || !std::isfinite(width) || !(range[0] + width > range[0]))
        throw tufted::InvalidInput("--energies " + energies + " is no FIRST,LAST, must be two ascending numbers");
    }
    stages = spectralStages(pairs.count);
    shown = {{wave ? "wks" : "hks", times.empty() ? samplesOrDefault() : std::ssize(times)}};
  }

  /// Refuses times in which heat does not reach the next point, for which a few eigenvalues do not suffice, and times
  /// after which it is constant up to rounding. In a time t heat spreads as far as the root of t.
  void checkTimes(const tufted::Spectrum& spectrum, const Operator& source) const {
    const double* const end = spectrum.values.data() + spectrum.values.size();
    const double* const smallest = std::upper_bound(spectrum.values.data(), end, 0.0);
    const double even = smallest == end ? INFINITY : -std::log(std::numeric_limits<double>::epsilon()) / *smallest;
    const Extent extent = extentOf(source);
    for (const double time : times) {
      const bool is_short = std::sqrt(time) < extent.spacing;
      if (!is_short && time <= even) continue;
      throw tufted::InvalidInput(
          "--times " + numberText(time) + ": heat goes " + numberText(std::sqrt(time)) +
          (is_short ? ", not to the next point: " : ", and after " + numberText(even) + " it is even: ") +
          extent.text());
    }
  }

  /// Refuses energies of which none lies among those of the eigenvalues, and warns if some are farther from all
  /// eigenvalues than the kernel is wide, where the nearest one counts alone.
  void checkEnergies(const tufted::Spectrum& spectrum, Results& results) const {
    if (range.empty()) return;
    const tufted::VectorXd known = tufted::waveEnergies(spectrum, 2);
    const std::string text = "--energies " + energies,
                      of_eigenvalues = "of the " + std::to_string(spectrum.values.size()) + " eigenvalues, " +
                                       numberText(known[0]) + " to " + numberText(known[1]);
    if (range[0] > known[1] || range[1] < known[0])
      throw tufted::InvalidInput(text + ": lie outside those " + of_eigenvalues);
    const double width = 7 * (range[1] - range[0]) / (samplesOrDefault() - 1);
    if (range[0] < known[0] - width || range[1] > known[1] + width)
      results.warnings.push_back(text + ": reach beyond those " + of_eigenvalues +
                                 ": there the signature is that of the nearest eigenvalue");
  }

  /// The signature, and its times or energies.
  std::vector<tufted::ResultArray> signatures(const tufted::Laplacian& laplacian,
                                              const tufted::Spectrum& spectrum) const {
    if (wave) {
      const int count = samplesOrDefault();
      const tufted::VectorXd at = range.empty() ? tufted::waveEnergies(spectrum, count)
                                                : tufted::VectorXd::LinSpaced(count, range[0], range[1]);
      return {{.name = "wks",
               .values = range.empty() ? tufted::waveKernelSignature(spectrum, count)
                                       : tufted::waveKernelSignature(spectrum, at, 7 * (at[1] - at[0]))},
              {.name = "energies", .values = at, .per_point = false}};
    }
    tufted::VectorXd used = Eigen::Map<const tufted::VectorXd>(times.data(), std::ssize(times));
    if (times.empty()) used = tufted::heatTimes(spectrum, samplesOrDefault());
    return {{.name = "hks", .values = tufted::heatKernelSignature(laplacian, spectrum, used)},
            {.name = "times", .values = used, .per_point = false}};
  }

  Results compute(Operator& source) override {
    const tufted::Spectrum spectrum = positivePairs(pairs, source);
    checkTimes(spectrum, source);
    Results results;
    checkEnergies(spectrum, results);
    results.arrays = signatures(source.laplacian, spectrum);
    results.summary.add(wave ? "energies" : "times", "%ld per point, of %ld eigenvalues up to %.6g",
                        static_cast<long>(results.arrays[0].values.cols()), static_cast<long>(spectrum.values.size()),
                        spectrum.values[spectrum.values.size() - 1]);
    addNullSpace(nullSpace(source.laplacian), false, results);
    results.arrays.push_back({.name = "evals", .values = spectrum.values, .per_point = false});
    addReport(spectrum.report, results);
    return results;
  }

  Eigenpairs pairs = {.count = 100};
  int samples = 0;  ///< 0: the default, 16 times or 100 energies
  bool wave = false;
  std::vector<double> times;
  std::string energies;
  std::vector<double> range;  ///< of `energies`, or empty

  int samplesOrDefault() const { return samples > 0 ? samples : wave ? 100 : 16; }
  std::vector<std::string> files() const override {
    return {wave ? "wks.npy" : "hks.npy", wave ? "energies.npy" : "times.npy", "evals.npy"};
  }
};

}  // namespace

void addHks(CLI::App& app, Run& run) {
  addSubcommand<Hks>(app, run);
}
