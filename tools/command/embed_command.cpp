#include "subcommand.h"
#include "tufted/signatures.h"

namespace {

struct Embed : Subcommand {
  explicit Embed(CLI::App& app)
      : Subcommand(app, "embed",
                   "Compute a spectral embedding: coordinates of every point from the smoothest eigenvectors.",
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
  report.json    method, iterations, residual, seconds)") {
    addCount(command, pairs, "--dimension", 1, "Number of coordinates of each point (3, or all if fewer)")
        ->type_name("D");
    addSpectrumFolder(command, pairs);
    addChoice(command, "--distance", embedding, kinds_of_distance,
              "Distance that Euclidean distances between embedded points approximate (commute)");
  }

  static inline const std::map<std::string, tufted::Embedding> kinds_of_distance = {
      {"commute", tufted::Embedding::commute}, {"biharmonic", tufted::Embedding::biharmonic}};

  void check(const Operator& source) override {
    checkPairs(pairs, source);
    stages = spectralStages(pairs.count);
    shown = {{"embedding", pairs.count}};
  }

  Results compute(Operator& source) override {
    const tufted::Spectrum spectrum = positivePairs(pairs, source);
    Results results;
    results.arrays = {{.name = "embedding", .values = tufted::spectralEmbedding(spectrum, embedding)},
                      {.name = "evals", .values = spectrum.values, .per_point = false}};
    results.summary.add("coordinates", "%ld, eigenvalues from %.6g to %.6g", static_cast<long>(spectrum.values.size()),
                        spectrum.values[0], spectrum.values[spectrum.values.size() - 1]);
    addReport(spectrum.report, results);
    return results;
  }

  Eigenpairs pairs = {.count = 3};
  tufted::Embedding embedding = tufted::Embedding::commute;

  std::vector<std::string> files() const override { return {"embedding.npy", "evals.npy"}; }
};

}  // namespace

void addEmbed(CLI::App& app, Run& run) {
  addSubcommand<Embed>(app, run);
}
