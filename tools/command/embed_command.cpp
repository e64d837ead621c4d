#include <CLI/CLI.hpp>
#include <map>

#include "command.h"
#include "eigenpairs.h"
#include "operator.h"
#include "options.h"
#include "reports.h"
#include "tufted/signatures.h"

namespace embed_command {
namespace {

constexpr const char* description =
    "Compute a spectral embedding: coordinates of every point from the smoothest eigenvectors.";

constexpr const char* footer =
    R"(Example:
  tufted embed scan.ply --dimension 3 --out embedding

Each of the D smallest positive eigenvalues gives a coordinate, so that distances between embedded points approximate
  commute     commute times: eigenvectors divided by the roots of their eigenvalues (global point signature)
  biharmonic  the biharmonic distance: eigenvectors divided by their eigenvalues, in the unit of the points
The constants on connected components are left out. A coordinate is 0 on components where its eigenvector is 0.

Files in DIR, which replace older ones when all are complete:
  embedding.npy  N x D, float64; 0 at points that take no part, at coincident points as at their representative
  evals.npy      the D eigenvalues, in 1 / length^2
  points.ply     the points with the fields embedding_0, embedding_1, ..., float32; points.pcd with --format pcd: one
                 field embedding of D values
  report.json    method, iterations, residual, seconds
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --out DIR` wrote.)";

const std::map<std::string, tufted::Embedding> kinds_of_distance = {{"commute", tufted::Embedding::commute},
                                                                    {"biharmonic", tufted::Embedding::biharmonic}};

struct Settings {
  OperatorSettings source;
  Eigenpairs pairs = {.count = 3};
  tufted::Embedding embedding = tufted::Embedding::commute;

  std::vector<std::string> files() const { return {"embedding.npy", "evals.npy"}; }
};

void check(Settings& settings, const Operator& source) {
  checkPairs(settings.pairs, source);
  settings.source.stages = spectralStages(settings.pairs.count);
  settings.source.shown = {{"embedding", settings.pairs.count}};
}

Results compute(Settings& settings, Operator& source) {
  const tufted::Spectrum spectrum = positivePairs(settings.pairs, source);
  Results results;
  results.arrays = {{.name = "embedding", .values = tufted::spectralEmbedding(spectrum, settings.embedding)},
                    {.name = "evals", .values = spectrum.values, .per_point = false}};
  results.summary.add("coordinates", "%ld, eigenvalues from %.6g to %.6g", static_cast<long>(spectrum.values.size()),
                      spectrum.values[0], spectrum.values[spectrum.values.size() - 1]);
  addReport(spectrum.report, results);
  return results;
}

}  // namespace
}  // namespace embed_command

void addEmbed(CLI::App& app, Run& run) {
  using namespace embed_command;
  const auto [command, settings] = addOperatorCommand<Settings>(app, run, "embed", description, footer, compute, check);
  addCount(*command, settings->pairs, "--dimension", 1, "Number of coordinates of each point (3, or all if fewer)")
      ->type_name("D");
  addSpectrumFolder(*command, settings->pairs);
  addChoice(*command, "--distance", settings->embedding, kinds_of_distance,
            "Distance that Euclidean distances between embedded points approximate (commute)");
}
