#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/columns.h"

namespace tufted::io {

/// One value of each item of a numpy array.
struct NpyColumn {
  std::string name = {};                ///< name of the structure's member; empty in a plain array
  FieldType type = FieldType::float64;  ///< type in memory: half precision becomes float32, booleans uint8
  char kind = 'f';                      ///< numpy's letter for the type in the file: f, i, u, b
  std::size_t size = 0;                 ///< bytes in the file
  bool swapped = false;                 ///< whether the value is big endian in the file
  std::size_t offset = 0;               ///< bytes from the beginning of an item
};

/// An array of N or H x W items, each a structure or c values, of any real types, in any byte order and order of
/// dimensions. Borrows the bytes of the file.
struct NpyTable {
  std::string type;                    ///< "float16", "int32", ..., or "structures"
  std::vector<NpyColumn> members;      ///< members of a structure; empty for a plain array
  NpyColumn value;                     ///< the first value of each item of a plain array
  std::int64_t columns = 0;            ///< number of values of each item
  std::size_t dimensions = 0;          ///< number of dimensions of the array
  std::int64_t width = 0, height = 1;  ///< W and H; N and 1 for N items
  /// Bytes from one to the next in a plain array.
  std::size_t column_stride = 0, item_stride = 0, row_stride = 0;
  const char* values = nullptr;
  std::size_t end = 0;  ///< byte at which the values end in the file

  std::int64_t rows() const { return width * height; }
  /// Converts value c of all items.
  Field field(std::int64_t c) const;
};

/// Parses a .npy file and checks that it is long enough. Bytes after `end` are left to the caller.
/// @param bytes at least the header; the values too if NpyTable::field() is called
/// @param size bytes of the whole file
/// @param is_flat whether an array of one dimension holds N items of one value
/// @throws IoError for other types and shapes, saying how to convert them
NpyTable parseNpyTable(std::string_view bytes, std::size_t size, const std::filesystem::path& shown,
                       bool is_flat = false);

}  // namespace tufted::io
