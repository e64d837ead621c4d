#pragma once

#include <cstdint>
#include <vector>

#include "tufted/io/select.h"

namespace tufted::io {

/// The rows of the points that select() keeps, ascending; may be empty. @throws as select()
std::vector<int> chosenRows(const Geometry& geometry, const Selection& selection, const Progress& progress);

/// Throws InvalidInput: a selection keeps none of so many points.
[[noreturn]] void refuseNone(std::int64_t points);

}  // namespace tufted::io
