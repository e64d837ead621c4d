#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "tufted/io/read.h"

namespace tufted::io {

/// Which values each vertex has by the keyword [ST][C][N][4]OFF: x y z [w] [nx ny nz] [colour] [texture].
struct OffLayout {
  bool texture = false;
  bool colors = false;
  bool normals = false;
  bool homogeneous = false;

  /// Index among a vertex's values of the first one of the normal, and of the first one after it.
  std::size_t normal() const { return homogeneous ? 4 : 3; }
  std::size_t behindNormal() const { return normal() + (normals ? 3 : 0); }
};

/// Reads the binary form of OFF, made of 32-bit integers and floats. The standard's is big endian with colours of
/// faces; little endian or missing colours are recognised by the size of the file.
/// @param bytes the whole file
/// @param body byte at which the binary counts begin
/// @throws IoError naming the path and byte
Geometry readBinaryOff(const std::filesystem::path& path, std::string_view bytes, std::size_t body,
                       const OffLayout& layout, const Progress& progress);

}  // namespace tufted::io
