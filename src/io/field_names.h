#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "tufted/io/read.h"

namespace tufted::io {

std::string lower(std::string_view text);

/// Whether a text equals one of `others`.
inline bool isOneOf(std::string_view text, std::initializer_list<std::string_view> others) {
  return std::find(others.begin(), others.end(), text) != others.end();
}

/// Makes one word of a name: removes quotes and a unit in brackets, and replaces blanks, so "gps time [s]" becomes
/// gps_time. An empty name becomes "_", the name of padding.
std::string plainName(std::string_view name);

/// Known names for the `count` values of a field: x y z for xyz, nx ny nz for normals, red green blue for rgb. Empty if
/// the field is not known or `count` is not 3 or 4.
std::vector<std::string> partNames(std::string_view name, std::size_t count);

/// Renames the fields that are known to their fieldKey(); others keep their name as one word. If several fields have
/// one key, such as z and Elevation, the one whose name is the key gets it.
void nameFields(std::vector<Field>& fields);

}  // namespace tufted::io
