#include "io/npy.h"

#include <bit>

namespace tufted::io {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

std::string npyHeader(std::string_view descr, std::int64_t length) {
  constexpr std::size_t alignment = 64;
  constexpr std::size_t before = 10;  // magic, version and length of the dictionary
  std::string dictionary = "{'descr': '" + std::string(descr) + "', 'fortran_order': False, 'shape': (" +
                           (length < 0 ? "" : std::to_string(length) + ",") + "), }";
  dictionary.append(alignment - (before + dictionary.size() + 1) % alignment, ' ');
  dictionary += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(dictionary.size() & 0xff);
  header += static_cast<char>(dictionary.size() >> 8);
  return header + dictionary;
}

}  // namespace tufted::io
