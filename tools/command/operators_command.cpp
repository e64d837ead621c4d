#include <CLI/CLI.hpp>
#include <chrono>
#include <limits>
#include <string>

#include "command.h"
#include "operator.h"
#include "options.h"
#include "reports.h"
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
  report.json    iterations, residual and seconds of the spectrum, seconds of the gradients
gradX and gradY are slopes along the axes of the frames, by least squares over the neighbours in L. Points that take no
part have rows of zeros. FILE and the options of building are those of `tufted laplacian`; --operator takes what that
has written, with the points (of meshes points.ply, which has the triangles).)";

struct Settings {
  OperatorSettings source;
  int count = 128;

  std::vector<std::string> files() const { return {"operators.npz"}; }
};

/// What a folder may lack.
void check(Settings& settings, const Operator& source) {
  const tufted::Geometry& geometry = source.geometry;
  if (source.points() > 0 && geometry.points.rows() == 0)
    throw tufted::IoError(source.name + ": has no points, which `tufted laplacian --format npz,ply` writes");
  if (source.laplacian.L.rows() > 0 && !geometry.is_mesh && source.laplacian.frames.normals.rows() == 0)
    throw tufted::IoError(source.name + ": has neither frames of a cloud nor the triangles of a mesh, which " +
                          "`tufted laplacian --format npz,ply` writes");
  checkCount("--count", settings.count, source);
}

Results compute(Settings& settings, Operator& source) {
  const tufted::Geometry& geometry = source.geometry;
  const auto start = std::chrono::steady_clock::now();
  const tufted::Gradients gradients = geometry.is_mesh
                                          ? tufted::gradients(source.laplacian, geometry.points,
                                                              tufted::meshFrames(geometry.points, geometry.triangles))
                                          : tufted::gradients(source.laplacian, geometry.points);
  const std::chrono::duration<double> gradients_took = std::chrono::steady_clock::now() - start;
  const tufted::Spectrum spectrum = spectrumFor("--count", settings.count, source, source.spectrumOptions());
  Results results;
  results.summary.add("eigenvalues", "%d", settings.count);
  if (const int zeros = spectrum.report.null_space; 2 * zeros > settings.count)
    results.warnings.push_back(source.name + ": " + std::to_string(zeros) + " of " + std::to_string(settings.count) +
                               " eigenvalues are 0, one for each connected component; take more by --count, or fewer "
                               "components by --component largest or --min-component N");
  addReport(spectrum.report, results);
  results.report["gradients"] = {{"seconds", gradients_took.count()}};
  results.write = [&source, gradients, spectrum](const std::filesystem::path& dir,
                                                 const tufted::ResultOptions& options) {
    tufted::writeOperators(dir, source.laplacian, source.geometry, gradients, spectrum, options);
  };
  return results;
}

}  // namespace

void addOperators(CLI::App& app, Run& run) {
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "operators", description, footer, compute, check);
  addNumber(*command, "--count", settings->count, 1, std::numeric_limits<int>::max(), "Number of eigenvalues (128)")
      ->type_name("K");
}
