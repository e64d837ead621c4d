#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/columns.h"

namespace tufted::io {

/// One value of each item of an array of numpy.
struct NpyColumn {
  std::string name = {};                ///< of a structure's member; empty in a plain array
  FieldType type = FieldType::float64;  ///< half precision becomes float32, truth values uint8
  char kind = 'f';                      ///< numpy's letter: f, i, u, b
  std::size_t size = 0;                 ///< bytes in the file
  bool swapped = false;                 ///< whether the file has the other order of bytes
  std::size_t offset = 0;               ///< from the beginning of an item
};

/// An array of points or of rows of values, of any real type, order of bytes and order of dimensions: N x c, H x W x c,
/// or structures, N or H x W. Borrows the bytes of the file.
struct NpyTable {
  std::string type;                    ///< "float16", "int32", ..., or "structures"
  std::vector<NpyColumn> members;      ///< of structures
  NpyColumn value;                     ///< the first value of each item of a plain array
  std::int64_t columns = 0;            ///< values of each item
  std::size_t dimensions = 0;          ///< of the array
  std::int64_t width = 0, height = 1;  ///< H x W; height is 1 where there is one dimension of items
  std::size_t column_stride = 0, item_stride = 0, row_stride = 0;  ///< bytes from one to the next, of a plain array
  const char* values = nullptr;
  std::size_t end = 0;  ///< where the values end in the file

  std::int64_t rows() const { return width * height; }
  /// Converts column c of all items.
  Field field(std::int64_t c) const;
};

/// Parses a .npy file and checks that it is long enough; what lies behind `end` is the caller's.
/// @param is_flat whether N values are N items of one value
/// @throws IoError for other types and shapes, saying how to convert them
NpyTable parseNpyTable(std::string_view bytes, const std::filesystem::path& shown, bool is_flat = false);

}  // namespace tufted::io
