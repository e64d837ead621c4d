#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "shapes/shapes.h"
#include "tufted/types.h"

// Public meshes as shapes with a known spectrum, for judging clouds on what is no sphere.

namespace tufted::bench {

/// The half of the shapes or scans that constants are chosen on, or the half that is looked at once.
enum class Half { choosing, held_out, both };

/// Meshes of the folder `shapes` and of libcgal-demo, each in one half.
struct ShapeFile {
  std::filesystem::path path;
  Half half;
};
/// @param shapes the folder `real/shapes`
/// @returns those that exist
std::vector<ShapeFile> shapeFiles(const std::filesystem::path& shapes);

/// The component with the largest area of a mesh, centred and of size 1.
struct RealShape {
  std::string name;
  shapes::Mesh mesh;
  double area = 0;
  VectorXd eigenvalues;  ///< the first positive ones
};
/// @param eigenvalues how many; 0: none are found
/// @throws IoError
RealShape realShape(const std::filesystem::path& path, int eigenvalues);

/// Points drawn on a shape, uniformly by area, with noise in all directions, and the normals there without it.
/// @param noise standard deviation in spacings, the root of the area per point
shapes::Cloud sampleOf(const RealShape& shape, int points, double noise, std::uint64_t seed);

}  // namespace tufted::bench
