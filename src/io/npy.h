#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tufted/io/read.h"

namespace tufted::io {

/// Makes the header of a .npy file, version 1.0, in C order, padded so that the values begin at a multiple of 64 bytes
/// (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html).
/// @param descr numpy's name of the type, such as "<f8"
/// @param shape empty for a single value
std::string npyHeader(std::string_view descr, const std::vector<std::int64_t>& shape);

/// Byte at which the dictionary of a header begins, for messages; from version 2 on two bytes later.
constexpr std::size_t npy_dictionary = 10;

/// The header of any .npy file.
struct NpyLayout {
  std::string_view descr;           ///< text of the header from the type, a literal of Python, to the end
  std::vector<std::int64_t> shape;  ///< empty: a single value
  std::size_t bytes = 0;            ///< size of the header; the values begin there
  bool is_by_columns = false;       ///< whether values are in Fortran order
};

/// The header of an array of one type in C order.
struct NpyHeader {
  std::string descr;                ///< numpy's name of the type
  std::optional<FieldType> type;    ///< type of little-endian floats and integers; nullopt for others
  std::vector<std::int64_t> shape;  ///< empty: a single value
  std::size_t bytes = 0;            ///< size of the header; the values begin there

  std::int64_t size() const;
};

constexpr std::size_t npy_beginning = 12;  ///< number of bytes that npyHeaderBytes() needs

/// The size of the header in bytes, by the first `npy_beginning` bytes of a file called `shown`.
/// @throws IoError for a file that is not a .npy file of version 1 to 3
std::size_t npyHeaderBytes(std::string_view beginning, const std::filesystem::path& shown);

/// Parses a header.
/// @param bytes at least the header; must outlive the result
/// @throws IoError for a file that is not a .npy file of version 1 to 3
NpyLayout parseNpyLayout(std::string_view bytes, const std::filesystem::path& shown);

/// Parses the header of an array in C order, and compares its shape with the size of the file.
/// @param bytes at least the header
/// @param all size of the file in bytes
/// @throws IoError for another size, Fortran order, or a file that is not a .npy file of version 1 to 3
NpyHeader parseNpyHeader(std::string_view bytes, std::uint64_t all, const std::filesystem::path& shown);

/// The type of an array of numbers. @throws IoError for an array that does not hold numbers
FieldType numberType(const NpyHeader& header, const std::filesystem::path& shown);

/// Numbers as doubles, in the order of the file. @throws IoError for an array that does not hold numbers
/// @param values bytes of whole numbers of the array
std::vector<double> numbersOf(const NpyHeader& header, std::string_view values, const std::filesystem::path& shown);

}  // namespace tufted::io
