#pragma once

#include <string>
#include <string_view>

namespace tufted::io {

/// Parses a whole token, whatever the locale. Decimal numbers may have a leading '+', and `nan`, `inf` and
/// Microsoft's `1.#QNAN` and `1.#INF` are numbers. Numbers that are too large become infinite, too small ones zero.
/// Integers may be written as decimals of the same value (`3.0`).
/// Instantiated for the types of FieldType. False if the token is no such number.
template <class T>
bool parseNumber(std::string_view token, T& value);

/// The shortest text that is read back as the same value.
std::string shortestText(double value);

}  // namespace tufted::io
