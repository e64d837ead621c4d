#include "subcommand.h"
#include "tufted/gradient.h"
#include "tufted/io/operators.h"

namespace {

struct Operators : Subcommand {
  explicit Operators(CLI::App& app)
      : Subcommand(
            app, "operators", "Write operators for learning on surfaces into one .npz, as DiffusionNet caches them.",
            R"(Example:
  tufted operators scan.ply --count 128 --out operators

Files in DIR, which replace older ones when all are complete:
  operators.npz  float64: verts, faces, frames (N x 3 x 3: x axis, y axis, normal), k_eig, mass, evals, evecs, and L,
                 gradX, gradY as the arrays _data, _indices, _indptr, _shape of csc matrices. The names are those of
                 DiffusionNet's cache. Its file names are hashes, so load this file and pass its arrays on.
  points.ply     the points with the fields frames and evecs, float32; points.pcd with --format pcd
  report.json    iterations, residual and seconds of the spectrum, neighbours and seconds of the gradients
gradX and gradY are slopes along the axes of the frames, by least squares over the nearest points. Rows of points that
take no part are zero.)",
            R"(--out DIR` wrote, and needs points.ply or points.pcd in DIR (of a mesh points.ply, for the triangles).)") {
    addCount(command, pairs, "--count", 1, "Number of eigenvalues, including zeros (128, or all if fewer)");
    addSpectrumFolder(command, pairs);
    addNumber(command, "--gradient-neighbors N", gradients.neighbors, 0, 10'000,
              "Number of neighbours in each fit of a gradient; 0: the neighbours in L (30 for clouds, 0 for meshes)");
    addNumber(command, "--gradient-regularization A", gradients.regularization, 0.0, std::numeric_limits<double>::max(),
              "Regularization of the fits, in squared units of length; DiffusionNet uses 1e-5 (0)");
  }

  /// Checks that a folder has what is needed.
  void check(const Operator& source) override {
    const tufted::Geometry& geometry = source.geometry;
    if (source.points() > 0 && geometry.points.rows() == 0)
      throw tufted::IoError(source.name + ": has no points, which `tufted laplacian --format npz,ply` writes");
    if (source.laplacian.L.rows() > 0 && !geometry.is_mesh && source.laplacian.frames.normals.rows() == 0)
      throw tufted::IoError(source.name + ": has neither frames of a cloud nor the triangles of a mesh, which " +
                            "`tufted laplacian --format npz,ply` writes");
    checkPairs(pairs, source);
    stages = spectralStages(pairs.count);
    shown = {{"evecs", pairs.folder.empty() ? pairs.count : 0}};
  }

  Results compute(Operator& source) override {
    const tufted::Geometry& geometry = source.geometry;
    tufted::GradientOptions fitting = gradients;
    fitting.threads = source.threads;
    fitting.progress = source.progress;
    // Folders of older versions have no positions; slopes are then measured between the points.
    const tufted::Points& measured =
        source.laplacian.positions.rows() > 0 ? source.laplacian.positions : geometry.points;
    const tufted::Gradients found =
        geometry.is_mesh
            ? tufted::gradients(source.laplacian, geometry.points,
                                tufted::meshFrames(source.laplacian, geometry.points, geometry.triangles), fitting)
            : tufted::gradients(source.laplacian, measured, fitting);
    const tufted::Spectrum spectrum = firstPairs(pairs, source);
    Results results;
    const auto count = static_cast<int>(spectrum.values.size());
    results.summary.add("eigenvalues", "%d", count);
    if (const int zeros = std::min(spectrum.report.null_space, count); 2 * zeros > count)
      results.warnings.push_back(source.name + ": " + std::to_string(zeros) + " of " + std::to_string(count) +
                                 " eigenvalues are 0, one for each connected component; take more by --count, or fewer "
                                 "components by --component largest or --min-component N");
    addReport(spectrum.report, results);
    const tufted::GradientReport& fits = found.report;
    results.report["gradients"] = {{"mean_neighbors", fits.mean_neighbors},
                                   {"widened", fits.widened},
                                   {"on_a_line", fits.on_a_line},
                                   {"regularization", fitting.regularization},
                                   {"seconds", fits.seconds}};
    results.summary.addDetail("gradients", "of %.3g neighbors on average, %.3g s", fits.mean_neighbors, fits.seconds);
    results.shown = {{.name = "evecs", .values = spectrum.vectors}};
    results.write = [&source, found, spectrum](const std::filesystem::path& dir, const tufted::ResultOptions& options) {
      tufted::writeOperators(dir, source.laplacian, source.geometry, found, spectrum, options);
    };
    return results;
  }

  Eigenpairs pairs = {.count = 128, .has_zeros = true};
  tufted::GradientOptions gradients;

  std::vector<std::string> files() const override { return {"operators.npz"}; }
};

}  // namespace

void addOperators(CLI::App& app, Run& run) {
  addSubcommand<Operators>(app, run);
}
