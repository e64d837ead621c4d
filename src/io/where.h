#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tufted/io/select.h"

namespace tufted::io {

/// Parses a comparison of Selection::where. Both arguments are borrowed.
/// @return whether a point of the geometry satisfies it
/// @throws InvalidInput naming the comparison and the fault
std::function<bool(std::size_t point)> where(const Geometry& geometry, const std::string& comparison);

/// The rows of the points that select() keeps, ascending; may be empty. @throws as select()
std::vector<int> chosenRows(const Geometry& geometry, const Selection& selection, const Progress& progress);

/// Throws InvalidInput: a selection keeps none of so many points.
[[noreturn]] void refuseNone(std::int64_t points);

}  // namespace tufted::io
