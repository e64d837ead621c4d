#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>

#include "oracles/oracles.h"
#include "shapes/shapes.h"
#include "shapes/spectra.h"
#include "tufted/laplacian.h"
#include "tufted/solver.h"

// How well the spectrum of the unit sphere is met, as CSV for plot_spectrum.py: random points, 48 eigenvalues (l = 1
// to 6 in full), two ways of gluing the stars, and as a yardstick the cotan Laplacian of the points' convex hull. Also
// the error of Poisson's equation, in L2 relative to the solution.

namespace {

constexpr int eigenvalues = 49;  // the first one is zero and does not count

double spectrumError(const tufted::SparseMatrix& L, const tufted::VectorXd& M) {
  return tufted::oracles::meanRelativeError(tufted::oracles::smallestEigenvalues(L, M, eigenvalues),
                                            tufted::shapes::sphereSpectrum(eigenvalues));
}

double gluingError(const tufted::Points& points, tufted::Gluing gluing) {
  const tufted::Laplacian laplacian = tufted::pointCloudLaplacian(
      points, {.steps = tufted::cloudSteps(tufted::Preset::clean), .keep_cover = false, .paper = {.gluing = gluing}});
  return spectrumError(laplacian.L, laplacian.M);
}

double hullError(const tufted::Points& points) {
  const auto [L, M] = tufted::oracles::cotanLaplacian(points, tufted::oracles::convexHullMesh(points));
  return spectrumError(L, M);
}

double poissonError(const tufted::Points& points) {
  const tufted::Laplacian laplacian =
      tufted::pointCloudLaplacian(points, {.steps = tufted::cloudSteps(tufted::Preset::clean), .keep_cover = false});
  const tufted::VectorXd& M = laplacian.M;
  const auto [u, f] = tufted::shapes::spherePoisson(points);
  const tufted::VectorXd found = tufted::Solver::laplacian(laplacian).solve(M.cwiseProduct(f));
  const tufted::VectorXd expected = u.array() - M.dot(u) / M.sum();
  return std::sqrt(M.dot((found - expected).cwiseAbs2()) / M.dot(expected.cwiseAbs2()));
}

void printRow(const char* method, int points, std::uint64_t seed, double error) {
  std::printf("%s,%d,%d,%.3e\n", method, points, static_cast<int>(seed), error);
  std::fflush(stdout);
}

}  // namespace

int main() {
  try {
    std::printf("method,points,seed,error\n");
    for (const int n : {1000, 4000, 16000, 64000})
      for (const std::uint64_t seed : {1, 2, 3}) {
        const tufted::Points points = tufted::shapes::sphere(n, tufted::shapes::Sampling::uniform, seed).points;
        printRow("star", n, seed, gluingError(points, tufted::Gluing::star));
        printRow("vertex_pair", n, seed, gluingError(points, tufted::Gluing::vertex_pair));
        printRow("convex_hull", n, seed, hullError(points));
        printRow("poisson", n, seed, poissonError(points));
      }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tufted_accuracy: %s\n", error.what());
    return 1;
  }
}
