#pragma once

#include <vector>

#include "tufted/io/read.h"

namespace tufted::io {

/// The place of a value in a point record of a LAS file: some bytes, or some bits of one byte.
struct LasItem {
  const char* name;
  FieldType type;
  int byte;
  int first_bit = 0;
  int bits = 0;  ///< 0: the whole value
};

/// The items of point format 0 to 10 after x, y, z, in the order of their bytes (ASPRS, LAS Specification 1.4 R15,
/// Tables 10 to 22).
std::vector<LasItem> lasItems(int format);

}  // namespace tufted::io
