#include <CLI/CLI.hpp>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "operator.h"
#include "options.h"
#include "progress_bar.h"
#include "spectrum_report.h"
#include "tufted/errors.h"
#include "tufted/spectrum.h"

namespace {

constexpr const char* description = "Eigenvalues and eigenvectors of L x = lambda M x, the smallest ones.";

constexpr const char* footer =
    R"(Eigenvalues are ascending, in 1 / length^2. Vectors are M-orthonormal, and of both signs
that is taken which makes the largest entry positive. Each connected component has the eigenvalue 0 once, exactly, with
a constant on it.

Writes into DIR, renamed one after the other when all are complete:
  evals.npy    K eigenvalues, float64
  evecs.npy    N x K, float64; 0 at points that take no part, coincident ones as their representative
  points.ply   the points with evecs_0, evecs_1, ... as fields of float32; points.pcd with --format pcd: a field evecs
               of K values
  report.json  iterations, residual, seconds
FILE and the options of building are those of `tufted laplacian`; --operator takes what that has written.)";

struct Settings {
  OperatorSettings source;
  int count = 32;
  tufted::SpectrumOptions options;
};

int runSpectrum(Settings& settings) {
  ProgressBar bar;
  const tufted::Progress progress = showOn(bar);
  const std::vector<std::string> files = {"evals.npy", "evecs.npy", "points.ply", "points.pcd", "report.json"};
  const Operator source = loadOperator(settings.source, files, false, progress);
  settings.options.threads = settings.source.threads();
  settings.options.progress = progress;
  tufted::Spectrum spectrum = tufted::spectrum(source.laplacian, settings.count, settings.options);
  const nlohmann::ordered_json report = {{"report", reportOf(spectrum.report)}};
  const double first = spectrum.values[0], last = spectrum.values[spectrum.values.size() - 1];
  writeOperatorResults(settings.source, "spectrum", source,
                       {{.name = "evals", .values = spectrum.values, .per_point = false},
                        {.name = "evecs", .values = std::move(spectrum.vectors)}},
                       report.dump(), progress);
  bar.clear();
  std::printf("%-15s %d, from %.6g to %.6g\n", "eigenvalues", settings.count, first, last);
  printSpectrumReport(spectrum.report);
  std::printf("%-15s %s\n", "written to", settings.source.out.c_str());
  if (std::fflush(stdout) != 0) throw tufted::IoError("standard output: cannot write the summary");
  return exit_done;
}

}  // namespace

void addSpectrum(CLI::App& app, Run& run) {
  CLI::App& command = *app.add_subcommand("spectrum", description);
  command.footer(footer);
  const auto settings = std::make_shared<Settings>();
  addOperatorOptions(command, settings->source);
  addNumber(command, "--count", settings->count, 1, std::numeric_limits<int>::max(), "Number of eigenvalues (32)")
      ->type_name("K");
  addNumber(command, "--tolerance", settings->options.tolerance, 1e-15, 0.5, "Relative accuracy of vectors (1e-10)")
      ->type_name("T");
  command.callback([&run, settings] { run = [=] { return runSpectrum(*settings); }; });
}
