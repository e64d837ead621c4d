#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "shapes/shapes.h"
#include "tufted/types.h"

// Public meshes as shapes with a known spectrum, for judging clouds of other shapes than spheres.

namespace tufted::bench {

/// The half of the shapes or scans on which constants are chosen, or the half on which they are tested.
enum class Half { choosing, held_out, both };

/// A file of a shape or scan, and its half.
struct ShapeFile {
  std::filesystem::path path;
  Half half;
};
/// The files of folders, sorted; folders that do not exist have none.
inline std::vector<std::filesystem::path> filesIn(const std::vector<std::filesystem::path>& folders) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& folder : folders)
    if (exists(folder))
      for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry);
  std::sort(files.begin(), files.end());
  return files;
}

/// The meshes of the folder `shapes` (`real/shapes`) and of libcgal-demo that exist.
std::vector<ShapeFile> shapeFiles(const std::filesystem::path& shapes);

/// The component of a mesh with the largest area, centred and scaled to size 1.
struct RealShape {
  std::string name;
  shapes::Mesh mesh;
  double area = 0;
  VectorXd eigenvalues;  ///< the first positive ones
};
/// Reads a shape.
/// @param eigenvalues number of eigenvalues to compute
/// @throws IoError
RealShape realShape(const std::filesystem::path& path, int eigenvalues);

/// A smooth surface near the mesh of a shape, by Loop's subdivision, in at least `faces` triangles; no triangles if the
/// mesh is not manifold.
RealShape smoothed(const RealShape& shape, int faces);

/// Random points of a shape, uniform by area, with noise in all directions, and the exact normals.
/// @param noise standard deviation in spacings, the root of the area per point
shapes::Cloud sampleOf(const RealShape& shape, int points, double noise, std::uint64_t seed);

}  // namespace tufted::bench
