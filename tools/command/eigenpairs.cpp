#include "eigenpairs.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <utility>

#include "options.h"
#include "tufted/errors.h"

namespace {

/// Reduces a spectrum to the number of pairs that is given, if any.
/// @throws InvalidInput naming the option if there are fewer
void keepFirst(const Eigenpairs& pairs, tufted::Spectrum& spectrum) {
  if (!pairs.is_given) return;
  const auto has = spectrum.values.size();
  if (pairs.count > has)
    throw tufted::InvalidInput(pairs.option + " " + std::to_string(pairs.count) + ": " + pairs.folder.string() +
                               " has " + std::to_string(has) + " of these eigenvalues");
  spectrum.values.conservativeResize(pairs.count);
  spectrum.vectors.conservativeResize(Eigen::NoChange, pairs.count);
}

}  // namespace

CLI::Option* addCount(CLI::App& command, Eigenpairs& pairs, const std::string& option, int least,
                      const std::string& help) {
  pairs.option = option;
  return addNumber(command, option, pairs.count, least, std::numeric_limits<int>::max(), help)
      ->each([&pairs](const std::string&) { pairs.is_given = true; })
      ->type_name("K");
}

void addSpectrumFolder(CLI::App& command, Eigenpairs& pairs) {
  addText(command, "--spectrum DIR", pairs.folder,
          "Use eigenvectors that `tufted spectrum --out DIR` wrote for the same L and M (all in DIR)")
      ->excludes(command.get_option("--solver"))
      ->excludes(command.get_option("--memory-limit"));
}

void checkPairs(const Eigenpairs& pairs, const Operator& source) {
  if (pairs.folder.empty()) {
    const int most = source.points() - (pairs.has_zeros ? 0 : 1);
    if (!pairs.is_given || pairs.count <= most) return;
    throw tufted::InvalidInput(pairs.option + " = " + std::to_string(pairs.count) + ", must be at most " +
                               std::to_string(most) + ", of " + std::to_string(source.points()) + " points");
  }
  const std::vector<std::string> files = tufted::filesOfResult(pairs.folder);
  for (const char* name : {"evals.npy", "evecs.npy"})
    if (std::find(files.begin(), files.end(), name) == files.end())
      throw tufted::IoError(pairs.folder.string() + ": its last result has no " + name +
                            ", which `tufted spectrum` writes");
}

int countOf(const Eigenpairs& pairs, const Operator& source, bool null_space) {
  if (pairs.is_given) return pairs.count;
  return std::clamp(tufted::mostEigenpairs(source.laplacian, null_space), 1, pairs.count);
}

tufted::Spectrum computedPairs(const Eigenpairs& pairs, int count, const Operator& source,
                               const tufted::SpectrumOptions& options) {
  const auto compute = [&] { return tufted::spectrum(source.laplacian, count, options); };
  return pairs.is_given ? forOption(pairs.option + " " + std::to_string(pairs.count), compute) : compute();
}

tufted::Spectrum readPositivePairs(const Eigenpairs& pairs, const Operator& source) {
  tufted::Spectrum spectrum = tufted::readSpectrum(pairs.folder, source.laplacian);
  const Eigen::Index positive = spectrum.values.size() - spectrum.report.null_space;
  spectrum.values = spectrum.values.tail(positive).eval();
  spectrum.vectors = spectrum.vectors.rightCols(positive).eval();
  return spectrum;
}

tufted::Spectrum positivePairs(const Eigenpairs& pairs, const Operator& source) {
  if (!pairs.folder.empty()) {
    tufted::Spectrum spectrum = readPositivePairs(pairs, source);
    keepFirst(pairs, spectrum);
    return spectrum;
  }
  tufted::SpectrumOptions options = source.spectrumOptions();
  options.null_space = false;
  return computedPairs(pairs, countOf(pairs, source, false), source, options);
}

tufted::Spectrum firstPairs(const Eigenpairs& pairs, const Operator& source) {
  if (pairs.folder.empty()) return computedPairs(pairs, countOf(pairs, source, true), source, source.spectrumOptions());
  tufted::Spectrum positive = readPositivePairs(pairs, source);
  const int nulls = nullSpace(source.laplacian);
  if (nulls == 0) return positive;
  tufted::Spectrum all = tufted::spectrum(source.laplacian, nulls);  // constants only, found without iterations
  const Eigen::Index count = nulls + positive.values.size();
  all.values.conservativeResize(count);
  all.vectors.conservativeResize(Eigen::NoChange, count);
  all.values.tail(positive.values.size()) = positive.values;
  all.vectors.rightCols(positive.values.size()) = positive.vectors;
  all.report = positive.report;
  all.report.null_space = nulls;
  keepFirst(pairs, all);
  return all;
}

int nullSpace(const tufted::Laplacian& laplacian) {
  return tufted::mostEigenpairs(laplacian, true) - tufted::mostEigenpairs(laplacian, false);
}

void addNullSpace(int nulls, bool is_written, Results& results) {
  results.report["null_space"] = nulls;
  results.summary.add("null space", "%d, a constant on each connected component, %s", nulls,
                      is_written ? "written first" : "not written");
}
