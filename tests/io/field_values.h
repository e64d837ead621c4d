#pragma once

#include <algorithm>
#include <cstring>
#include <string_view>
#include <vector>

#include "tufted/io/read.h"

/// The field of that name, or a null pointer.
inline const tufted::Field* fieldNamed(const tufted::Geometry& geometry, std::string_view name) {
  const auto field = std::find_if(geometry.fields.begin(), geometry.fields.end(),
                                  [&](const tufted::Field& candidate) { return candidate.name == name; });
  return field == geometry.fields.end() ? nullptr : &*field;
}

/// The values of a field, whose type the caller knows.
template <class T>
std::vector<T> valuesOf(const tufted::Field& field) {
  std::vector<T> values(field.bytes.size() / sizeof(T));
  std::memcpy(values.data(), field.bytes.data(), field.bytes.size());
  return values;
}
