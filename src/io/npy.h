#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tufted::io {

/// The header of a .npy file, version 1.0: C order, little endian, padded so that the values begin at a multiple of
/// 64 bytes (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html).
/// @param descr numpy's name of the type, such as "<f8"
/// @param length of a one-dimensional array; negative for a single value
std::string npyHeader(std::string_view descr, std::int64_t length);

}  // namespace tufted::io
