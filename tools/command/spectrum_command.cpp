#include <CLI/CLI.hpp>

#include "command.h"
#include "eigenpairs.h"
#include "operator.h"
#include "options.h"
#include "reports.h"
#include "tufted/spectrum.h"

namespace spectrum_command {
namespace {

constexpr const char* description = "Compute the smallest eigenvalues of L x = lambda M x, and their eigenvectors.";

constexpr const char* footer =
    R"(Example:
  tufted spectrum scan.ply --count 64 --out spectrum

Eigenvalues are in ascending order, in 1 / length^2. Eigenvectors are M-orthonormal; the sign of each makes the entry of
the largest magnitude positive. Each connected component also has the eigenvalue 0 exactly once, with an eigenvector
that is constant on the component. The summary states the size of this null space; --with-null-space writes it before
the K others.

Files in DIR, which replace older ones when all are complete:
  evals.npy    K positive eigenvalues, float64
  evecs.npy    N x K, float64; 0 at points that take no part, at coincident points as at their representative
  points.ply   the points with the fields evecs_0, evecs_1, ..., float32; points.pcd with --format pcd: one field evecs
               of K values
  report.json  size of the null space, checksum of L and M, method, iterations, residual, seconds
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --out DIR` wrote.)";

struct Settings {
  OperatorSettings source;
  Eigenpairs pairs = {.count = 32};
  bool with_null_space = false;
  double tolerance = tufted::SpectrumOptions().tolerance;

  std::vector<std::string> files() const { return {"evals.npy", "evecs.npy"}; }
};

void check(Settings& settings, const Operator& source) {
  checkPairs(settings.pairs, source);
  const int count = settings.pairs.count;
  settings.source.stages = spectralStages(count);
  settings.source.shown = {{"evecs", settings.with_null_space ? 0 : count, count}};
}

Results compute(Settings& settings, Operator& source) {
  tufted::SpectrumOptions options = source.spectrumOptions();
  options.tolerance = settings.tolerance;
  options.null_space = settings.with_null_space;
  const int nulls = nullSpace(source.laplacian), count = countOf(settings.pairs, source, false);
  tufted::Spectrum spectrum =
      computedPairs(settings.pairs, count + (settings.with_null_space ? nulls : 0), source, options);
  Results results;
  results.summary.add("eigenvalues", "%d positive ones, from %.6g to %.6g", count,
                      spectrum.values[spectrum.values.size() - count], spectrum.values[spectrum.values.size() - 1]);
  addNullSpace(nulls, settings.with_null_space, results);
  results.report["checksum"] = tufted::checksum(source.laplacian);
  addReport(spectrum.report, results);
  results.arrays = {{.name = "evals", .values = spectrum.values, .per_point = false},
                    {.name = "evecs", .values = std::move(spectrum.vectors)}};
  return results;
}

}  // namespace
}  // namespace spectrum_command

void addSpectrum(CLI::App& app, Run& run) {
  using namespace spectrum_command;
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "spectrum", description, footer, compute, check);
  addCount(*command, settings->pairs, "--count", 1, "Number of positive eigenvalues (32, or all if fewer)");
  command->add_flag("--with-null-space", settings->with_null_space,
                    "Also write the eigenvalues 0 and their eigenvectors, before the others");
  addNumber(*command, "--tolerance", settings->tolerance, 1e-15, 0.5, "Relative accuracy of eigenvectors (1e-10)")
      ->type_name("T");
}
