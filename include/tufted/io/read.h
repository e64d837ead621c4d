#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tufted/types.h"

namespace tufted {

/// Number type of a field, as PCD and PLY name them (64-bit integers: PCD only).
enum class FieldType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// A further value per point that the file carries (colour, intensity, label, ...), kept as it was stored.
struct Field {
  std::string name;
  FieldType type = FieldType::float32;
  int count = 1;                 ///< values per point
  std::vector<std::byte> bytes;  ///< N * count values, native byte order
};

/// What a file holds: a cloud, or a mesh.
struct Geometry {
  Points points;              ///< N x 3, in the file's unit, float and double without loss
  Points normals;             ///< N x 3 where the file has them, else 0 x 3
  std::vector<Field> fields;  ///< everything else per point, in the file's order
  int width = 0;              ///< columns of an organized cloud; N otherwise
  int height = 1;             ///< rows of an organized cloud; 1 otherwise
  /// Pose of the sensor as PCD states it: translation x y z, then the unit quaternion w x y z.
  std::array<double, 7> viewpoint = {0, 0, 0, 1, 0, 0, 0};
  bool is_mesh = false;
  Triangles triangles;               ///< F x 3; polygons are triangulated, in order
  std::int64_t polygons = 0;         ///< faces of more than three corners that were triangulated
  std::int64_t merged_vertices = 0;  ///< STL corners merged with an equal earlier one
};

/// How to take a file that may be either.
enum class ReadAs {
  automatic,  ///< a mesh where the file has faces, else a cloud: an OBJ or OFF without faces too
  cloud,      ///< points only; faces are ignored
  mesh,       ///< a file without faces is an error
};

/// Reads PCD, PLY, XYZ (clouds) and PLY, OBJ, OFF, STL (meshes), by the file's extension.
/// @throws IoError naming the path, and the line or byte where known
Geometry read(const std::filesystem::path& path, ReadAs as = ReadAs::automatic);

}  // namespace tufted
