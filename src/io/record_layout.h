#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "tufted/io/read.h"

namespace tufted::io {

/// How a binary file holds its points: as records of one size. Consecutive records are a file of their own, behind a
/// header that counts no others, so the reader of the format reads a large file in parts.
struct RecordLayout {
  FileFormat format = FileFormat::automatic;
  std::int64_t points = 0;
  std::size_t record_bytes = 0;     ///< bytes of a point, or of one of its values if the file has `columns`
  std::int64_t columns = 1;         ///< if not 1, all first values of points come first, then all second ones, ...
  std::size_t begin = 0;            ///< byte at which the records begin
  std::size_t rest = 0;             ///< byte at which bytes begin that the file does not announce
  std::size_t end = 0;              ///< byte at which they end
  bool is_organized = false;        ///< whether the points are a grid of more than one row
  bool has_faces = false;           ///< whether faces follow
  bool is_named_by_values = false;  ///< whether names of fields depend on all values
  /// Makes the header of a file of so many of the points, without grid and faces.
  std::function<std::string(std::int64_t points)> header = {};
};

/// The layout of a LAS, binary PLY, binary PCD or NPY file.
/// @param bytes the file as far as its points at least
/// @param all size of the whole file
/// @return nullopt for files of other formats or without points, compressed ones, PLY with lists or elements before the
/// points, and grids of NPY in Fortran's order
/// @throws IoError if the header is not valid, or counts more than the file holds
std::optional<RecordLayout> recordLayout(const std::filesystem::path& path, std::string_view bytes, std::size_t all);

}  // namespace tufted::io
