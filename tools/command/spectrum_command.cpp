#include "subcommand.h"

namespace {

struct Spectrum : Subcommand {
  explicit Spectrum(CLI::App& app)
      : Subcommand(app, "spectrum", "Compute the smallest eigenvalues of L x = lambda M x, and their eigenvectors.",
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
  report.json  size of the null space, checksum of L and M, method, iterations, residual, seconds)") {
    addCount(command, pairs, "--count", 1, "Number of positive eigenvalues (32, or all if fewer)");
    command.add_flag("--with-null-space", with_null_space,
                     "Also write the eigenvalues 0 and their eigenvectors, before the others");
    addNumber(command, "--tolerance T", tolerance, 1e-15, 0.5, "Relative accuracy of eigenvectors (1e-10)");
  }

  void check(const Operator& source) override {
    checkPairs(pairs, source);
    const int count = pairs.count;
    stages = spectralStages(count);
    shown = {{"evecs", with_null_space ? 0 : count, count}};
  }

  Results compute(Operator& source) override {
    tufted::SpectrumOptions options = source.spectrumOptions();
    options.tolerance = tolerance;
    options.null_space = with_null_space;
    const int nulls = nullSpace(source.laplacian), count = countOf(pairs, source, false);
    tufted::Spectrum spectrum = computedPairs(pairs, count + (with_null_space ? nulls : 0), source, options);
    Results results;
    results.summary.add("eigenvalues", "%d positive ones, from %.6g to %.6g", count,
                        spectrum.values[spectrum.values.size() - count], spectrum.values[spectrum.values.size() - 1]);
    addNullSpace(nulls, with_null_space, results);
    results.report["checksum"] = tufted::checksum(source.laplacian);
    addReport(spectrum.report, results);
    results.arrays = {{.name = "evals", .values = spectrum.values, .per_point = false},
                      {.name = "evecs", .values = std::move(spectrum.vectors)}};
    return results;
  }

  Eigenpairs pairs = {.count = 32};
  bool with_null_space = false;
  double tolerance = tufted::SpectrumOptions().tolerance;

  std::vector<std::string> files() const override { return {"evals.npy", "evecs.npy"}; }
};

}  // namespace

void addSpectrum(CLI::App& app, Run& run) {
  addSubcommand<Spectrum>(app, run);
}
