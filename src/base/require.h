#pragma once

#include <cstdint>
#include <string>

#include "tufted/errors.h"

namespace tufted {

/// @param function what the caller called, and `what` there may be no more of than `most`
/// @throws InvalidInput that names all of it
inline void requireAtMost(std::int64_t most, std::int64_t count, const char* function, const char* what) {
  if (count <= most) return;
  throw InvalidInput(std::string(function) + ": " + std::to_string(count) + " " + what + ", must be at most " +
                     std::to_string(most));
}

}  // namespace tufted
