#pragma once

#include <string>
#include <string_view>

namespace tufted::io {

/// Parses a whole token, whatever the locale. Numbers may have a leading '+'; `nan`, `inf` and Microsoft's `1.#QNAN`
/// and `1.#INF` are numbers. Too large ones become infinite, too small ones zero. Integers may be written as decimals
/// of the same value (`3.0`). Instantiated for the types of FieldType.
/// @return false if the token is no such number
template <class T>
bool parseNumber(std::string_view token, T& value);

/// The shortest decimal text that parses to the same double.
std::string shortestText(double value);

}  // namespace tufted::io
