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
#include "tufted/gradient.h"
#include "tufted/io/operators.h"
#include "tufted/spectrum.h"

namespace {

constexpr const char* description = "Operators for learning on surfaces, in one .npz as DiffusionNet caches them.";

constexpr const char* footer = R"(Writes into DIR, renamed one after the other when all are complete:
  operators.npz  verts, faces, frames (N x 3 x 3: x axis, y axis, normal), k_eig, mass, evals, evecs, and L, gradX,
                 gradY as _data, _indices, _indptr, _shape of csc matrices; float64. The cache of DiffusionNet has
                 these names; its file names are hashes, so load this one and hand on its arrays.
  points.ply     the points with the fields frames and evecs, float32; points.pcd with --format pcd
  report.json    residual and seconds of the spectrum
gradX and gradY are slopes along the axes of the frames, by least squares over the neighbours in L. Points that take no
part have rows of zeros. FILE and the options of building are those of `tufted laplacian`.)";

struct Settings {
  OperatorSettings source;
  int count = 128;
};

int runOperators(Settings& settings) {
  ProgressBar bar;
  const tufted::Progress progress = showOn(bar);
  const Operator source = loadOperator(settings.source, {"points.ply", "points.pcd", "report.json"}, false, progress);
  const tufted::Geometry& geometry = source.geometry;
  const tufted::Gradients gradients = geometry.is_mesh
                                          ? tufted::gradients(source.laplacian, geometry.points,
                                                              tufted::meshFrames(geometry.points, geometry.triangles))
                                          : tufted::gradients(source.laplacian, geometry.points);
  tufted::SpectrumOptions options;
  options.threads = settings.source.threads();
  options.progress = progress;
  const tufted::Spectrum spectrum = tufted::spectrum(source.laplacian, settings.count, options);
  const nlohmann::ordered_json report = {{"tufted", TUFTED_VERSION},
                                         {"command", "operators"},
                                         {"source", settings.source.name()},
                                         {"report", reportOf(spectrum.report)}};
  const std::string text = report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  tufted::writeOperators(settings.source.out, source.laplacian, geometry, gradients, spectrum,
                         {.copies = settings.source.copies, .report = text, .progress = progress});
  bar.clear();
  std::printf("%-15s %d\n", "eigenvalues", settings.count);
  printSpectrumReport(spectrum.report);
  std::printf("%-15s %s\n", "written to", (settings.source.out / "operators.npz").c_str());
  if (std::fflush(stdout) != 0) throw tufted::IoError("standard output: cannot write the summary");
  return exit_done;
}

}  // namespace

void addOperators(CLI::App& app, Run& run) {
  CLI::App& command = *app.add_subcommand("operators", description);
  command.footer(footer);
  const auto settings = std::make_shared<Settings>();
  addOperatorOptions(command, settings->source, false);
  addNumber(command, "--count", settings->count, 1, std::numeric_limits<int>::max(), "Number of eigenvalues (128)")
      ->type_name("K");
  command.callback([&run, settings] { run = [=] { return runOperators(*settings); }; });
}
