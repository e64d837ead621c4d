#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "bench/tables.h"
#include "oracles/oracles.h"
#include "oracles/planar.h"
#include "shapes/shapes.h"
#include "tufted/interpolation.h"

// Tables of the accuracy of the algorithms, in Markdown.

namespace {

using tufted::Laplacian;
using tufted::Points;
namespace bench = tufted::bench;
namespace oracles = tufted::oracles;
namespace shapes = tufted::shapes;

/// The paper's Figure 15: by how much harmonic functions leave the range of their pins, relative to it.
void printObtuse() {
  std::printf("| square, obtuse boundary | cotan | intrinsic Delaunay | ours |\n|---|---|---|---|\n");
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const oracles::PlanarMesh given = oracles::obtuseSquare(200, 8, seed),
                              delaunay = oracles::obtuseSquare(200, 1, seed);
    const auto [pinned, values] = oracles::pinsAtObtuseCorners(given);
    const tufted::Pins pins{pinned, values};
    const auto outside = [&](const oracles::PlanarMesh& mesh, bool cotan) {
      Laplacian laplacian = tufted::meshLaplacian(mesh.points, mesh.triangles);
      if (cotan) laplacian.L = oracles::cotanLaplacian(mesh.points, mesh.triangles).L;
      const Eigen::MatrixXd u = tufted::harmonic(laplacian, pins);
      return std::max({0.0, -u.minCoeff(), u.maxCoeff() - 1});
    };
    std::printf("| sample %d | %.3g | %.3g | %.3g |\n", static_cast<int>(seed), outside(given, true),
                outside(delaunay, true), outside(given, false));
  }
}

/// L2 error at points more than 4 edges away from the source.
double greenError(const Laplacian& laplacian, const Points& points, double edge) {
  const Eigen::MatrixXd g = tufted::greensFunction(laplacian, {0});
  double square = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double chord = (points.row(i) - points.row(0)).norm();
    if (chord < 4 * edge) continue;
    const double error = g(i, 0) + (std::log(chord * chord / 4) + 1) / (4 * M_PI);
    square += laplacian.M[i] * error * error;
  }
  return std::sqrt(square);
}

void printGreen() {
  std::printf("| sphere, Green's function | cloud, L2 | hull mesh |\n|---|---|---|\n");
  for (const int n : {4000, 16000, 64000}) {
    const Points points = shapes::sphere(n).points;
    const Laplacian cloud = tufted::pointCloudLaplacian(points);
    const Laplacian hull = tufted::meshLaplacian(points, oracles::convexHullMesh(points));
    const double edge = std::sqrt(cloud.report.mean_squared_edge);
    std::printf("| %d | %.2e | %.2e |\n", n, greenError(cloud, points, edge), greenError(hull, points, edge));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::map<std::string, void (*)()> tables = {{"meshes", bench::printMeshes},
                                                    {"paths", bench::printPaths},
                                                    {"nonmanifold", bench::printNonmanifold},
                                                    {"sphere", bench::printSphere},
                                                    {"torus", bench::printTorus},
                                                    {"symmetry", bench::printSymmetry},
                                                    {"signed", bench::printSigned},
                                                    {"lines", bench::printLines},
                                                    {"logmap", bench::printLogMaps},
                                                    {"query", bench::printQuery},
                                                    {"peers", bench::printPeers},
                                                    {"obtuse", printObtuse},
                                                    {"green", printGreen},
                                                    {"maps", bench::printMaps},
                                                    {"disks", bench::printDisks},
                                                    {"minimal", bench::printMinimal},
                                                    {"smoothing", bench::printSmoothing},
                                                    {"noise", bench::printNoise},
                                                    {"handles", bench::printHandles},
                                                    {"weights", bench::printWeights},
                                                    {"depth", bench::printDepthImages},
                                                    {"depth-denoise", bench::printDenoisedImages},
                                                    {"depth-spectrum", bench::printDepthSpectra},
                                                    {"depth-curvature", bench::printDepthCurvatures},
                                                    {"frames", bench::printDepthImageSpeed}};
  CLI::App app("Tables of distances, interpolation, Green's functions, maps and moved points against what is exact.");
  std::vector<std::string> names;
  std::vector<std::string> known;
  for (const auto& [name, print] : tables) known.push_back(name);
  app.add_option("TABLE", names, "Which (all)")->check(CLI::IsMember(known));
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& name : names.empty() ? known : names) {
      tables.at(name)();
      std::printf("\n");
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tufted_applications: %s\n", error.what());
    return 1;
  }
}
