#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tufted::io {

/// The header of a .npy file, version 1.0: C order, little endian, padded so that the values begin at a multiple of
/// 64 bytes (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html).
/// @param descr numpy's name of the type, such as "<f8"
/// @param shape empty for a single value
std::string npyHeader(std::string_view descr, const std::vector<std::int64_t>& shape);

/// A .npy file in memory.
struct NpyArray {
  std::string descr;                ///< numpy's name of the type
  std::vector<std::int64_t> shape;  ///< empty: a single value
  std::string_view values;          ///< of the bytes that were parsed

  std::int64_t size() const;
};

/// @param shown the path to name in errors
/// @throws IoError for what is no .npy file of version 1 to 3 in C order, or has not as many bytes as its shape says
NpyArray parseNpy(std::string_view bytes, const std::filesystem::path& shown);

/// The numbers as doubles, in C order. @throws IoError for types other than floats and integers of little endian
std::vector<double> numbersOf(const NpyArray& array, const std::filesystem::path& shown);

}  // namespace tufted::io
