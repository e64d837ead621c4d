#pragma once

#include <functional>
#include <string>

#include "tufted/io/read.h"

namespace tufted::io {

/// Parses a comparison of Selection::where. Both arguments are borrowed.
/// @return whether a point of the geometry satisfies it
/// @throws InvalidInput naming the comparison and the fault
std::function<bool(std::size_t point)> where(const Geometry& geometry, const std::string& comparison);

}  // namespace tufted::io
