#include <algorithm>
#include <cmath>
#include <iterator>

#include "shapes/shapes.h"

namespace tufted::shapes {

std::vector<Cloud> allClouds(int size) {
  const int n = std::max(size, 500), side = static_cast<int>(std::lround(std::sqrt(double(n))));
  std::vector<Cloud> clouds;
  for (const Sampling sampling :
       {Sampling::uniform, Sampling::jittered, Sampling::lattice, Sampling::nonuniform, Sampling::scanLines(4),
        Sampling::scanLines(10), Sampling::scanLines(20), Sampling::scanLines(40)}) {
    clouds.push_back(sphere(n, sampling));
    clouds.push_back(torus(n, sampling));
    clouds.push_back(square(n, sampling));
  }
  for (const Sampling sampling : {Sampling::uniform, Sampling::jittered}) {
    clouds.push_back(square(n, sampling, Rim::included));
    clouds.push_back(disk(n, sampling));
    clouds.push_back(disk(n, sampling, Rim::included));
    clouds.push_back(cylinderPatch(n, sampling));
    clouds.push_back(saddle(n, sampling));
    clouds.push_back(saddle(n, sampling, Rim::included));
  }
  for (const double ratio : {16.0, 100.0}) clouds.push_back(sphere(n, Sampling::densityStep(ratio)));
  for (const Outliers where : {Outliers::near, Outliers::far}) clouds.push_back(withOutliers(sphere(n), where, 0.01));
  clouds.push_back(ellipsoid(std::min(n, 100000)));
  clouds.push_back(squareLattice(side));
  clouds.push_back(shuffled(squareLattice(side)));
  clouds.push_back(twoSheets(n, 0.1));
  clouds.push_back(crossingPlanes(n));
  clouds.push_back(cubeSurface(n));
  clouds.push_back(prismSurface(n));
  for (const double noise : {0.001, 0.005, 0.01}) {
    clouds.push_back(withNoise(sphere(n), noise));
    clouds.push_back(withNoise(torus(n), noise));
    clouds.push_back(withNoise(cubeSurface(n), noise));
  }
  // At least 5 steps of azimuth, so that rings go around the scanner.
  for (const int rings : {16, 64}) {
    const double step = 360.0 / std::max(5, n / rings);
    clouds.push_back(lidar({.rings = rings, .azimuth_step = step}));
    clouds.push_back(lidar({.rings = rings, .azimuth_step = step, .noise = 0.02}));
  }
  const int rows = std::max(24, static_cast<int>(std::sqrt(0.75 * n)));
  clouds.push_back(depthCamera({.width = rows * 4 / 3, .height = rows}));
  return clouds;
}

std::vector<Mesh> allMeshes() {
  std::vector<Mesh> meshes;
  for (const Quality quality : {Quality::good, Quality::bad}) {
    meshes.push_back(cubeMesh(8, quality));
    meshes.push_back(prismMesh(8, quality));
  }
  for (Mesh& mesh : std::vector<Mesh>{
           cubeQuads(6), prismQuads(6), tetrahedron(), icosphere(2), gridSquare(10), book(3, 6), book(5, 6), fins(8),
           bowTie(), bowTieCones(12), moebius(5), kleinBottle(16), slivers(8), zeroLengthEdges(8), repeatedVertices(8),
           unreferencedVertices(8), duplicateTriangles(8), mixedOrientation(8), severalComponents()}) {
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

}  // namespace tufted::shapes
