#include <cstdint>
#include <cstdio>
#include <exception>

#include "oracles/oracles.h"
#include "shapes/shapes.h"
#include "shapes/spectra.h"
#include "tufted/laplacian.h"

// How well the spectrum of the unit sphere is met, as CSV for plot_spectrum.py: random points, 48 eigenvalues (l = 1
// to 6 in full), two ways of gluing the stars, and as a yardstick the cotan Laplacian of the points' convex hull.

namespace {

constexpr int eigenvalues = 49;  // the first one is zero and does not count

double spectrumError(const tufted::SparseMatrix& L, const tufted::VectorXd& M) {
  return tufted::oracles::meanRelativeError(tufted::oracles::smallestEigenvalues(L, M, eigenvalues),
                                            tufted::shapes::sphereSpectrum(eigenvalues));
}

double gluingError(const tufted::Points& points, tufted::Gluing gluing) {
  const tufted::Laplacian laplacian = tufted::pointCloudLaplacian(
      points, {.steps = tufted::cloudSteps(tufted::Preset::clean), .gluing = gluing, .keep_cover = false});
  return spectrumError(laplacian.L, laplacian.M);
}

double hullError(const tufted::Points& points) {
  const auto [L, M] = tufted::oracles::cotanLaplacian(points, tufted::oracles::convexHullMesh(points));
  return spectrumError(L, M);
}

void printRow(const char* method, int points, std::uint64_t seed, double error) {
  std::printf("%s,%d,%d,%.3e\n", method, points, static_cast<int>(seed), error);
  std::fflush(stdout);
}

}  // namespace

int main() {
  try {
    std::printf("method,points,seed,mean_relative_error\n");
    for (const int n : {1000, 4000, 16000, 64000})
      for (const std::uint64_t seed : {1, 2, 3}) {
        const tufted::Points points = tufted::shapes::sphere(n, tufted::shapes::Sampling::uniform, seed).points;
        printRow("star", n, seed, gluingError(points, tufted::Gluing::star));
        printRow("vertex_pair", n, seed, gluingError(points, tufted::Gluing::vertex_pair));
        printRow("convex_hull", n, seed, hullError(points));
      }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tufted_accuracy: %s\n", error.what());
    return 1;
  }
}
