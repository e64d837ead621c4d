#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "tufted/io/read.h"

namespace tufted {

/// What the header of a file says.
struct FileHead {
  Geometry geometry;         ///< as read() returns it, but without points, normals, triangles and the values of fields
  std::int64_t points = 0;   ///< number of points
  std::int64_t faces = 0;    ///< number of faces; 0 for a file that is read as a cloud
  bool has_normals = false;  ///< whether the points have normals
};

/// Reads the header of a PCD, PLY or LAS file, which takes no longer for a large file than for a small one.
/// @param as as in read()
/// @return nullopt for files of other formats, files that are no regular files, and missing files
/// @throws IoError as read() does, if the header is not valid or counts more than the file holds
std::optional<FileHead> readHead(const std::filesystem::path& path, ReadAs as = ReadAs::automatic);

}  // namespace tufted
