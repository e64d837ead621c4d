#pragma once

#include <cstdint>
#include <string>

#include "tufted/errors.h"

namespace tufted {

/// Checks that `count` is at most `most`.
/// @param function the public function that was called
/// @param what is counted, in the plural
/// @throws InvalidInput with these words if `count` exceeds `most`
inline void requireAtMost(std::int64_t most, std::int64_t count, const char* function, const char* what) {
  if (count <= most) return;
  throw InvalidInput(std::string(function) + ": " + std::to_string(count) + " " + what + ", must be at most " +
                     std::to_string(most));
}

}  // namespace tufted
