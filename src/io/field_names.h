#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "tufted/io/read.h"

namespace tufted::io {

/// The text in small letters.
std::string lower(std::string_view text);

/// Whether a text is one of these.
inline bool isOneOf(std::string_view text, std::initializer_list<std::string_view> others) {
  return std::find(others.begin(), others.end(), text) != others.end();
}

/// One word without quotes, a unit in brackets and blanks: "gps time [s]" becomes gps_time. A column without a name
/// gets that of padding, "_".
std::string plainName(std::string_view name);

/// The names of the values of a field of several, if they have known ones: x y z of xyz, nx ny nz of normals, red green
/// blue of rgb; otherwise none.
std::vector<std::string> partNames(std::string_view name, std::size_t count);

/// Gives the fields the names that fieldKey() knows them by; others keep theirs as one word. Where two have the same
/// key, such as z and Elevation, the one that is called so keeps it.
void nameFields(std::vector<Field>& fields);

}  // namespace tufted::io
