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

constexpr const char* description = "Spectral embedding: coordinates of every point by the smoothest eigenvectors.";

constexpr const char* footer =
    R"(Example:
  tufted embed scan.ply --dimension 3 --out embedding

A coordinate for each of the D smallest positive eigenvalues, so that distances between embedded points are near
  commute     commute times: eigenvectors over the roots of their eigenvalues (global point signature)
  biharmonic  the biharmonic distance: eigenvectors over their eigenvalues, in the points' unit
Constants of components are left out; a coordinate is 0 on components that its eigenvector does not live on.

Writes into DIR, renamed one after the other when all are complete:
  embedding.npy  N x D, float64; 0 at points that take no part, coincident ones as their representative
  evals.npy      the D eigenvalues, 1 / length^2
  points.ply     the points with embedding_0, embedding_1, ... as fields of float32; points.pcd with --format pcd: a
                 field embedding of D values
  report.json    method, iterations, residual, seconds
FILE and the options of building are those of `tufted laplacian`; --operator takes what that has written.)";

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
