#pragma once

#include <cstdint>
#include <string>

#include "tufted/errors.h"

namespace tufted {

/// @param function the public function that was called
/// @throws InvalidInput always
[[noreturn]] inline void refuse(const std::string& function, const std::string& why) {
  throw InvalidInput(function + ": " + why);
}

/// Checks that `count` is at most `most`.
/// @param function the public function that was called
/// @param what is counted, in the plural
/// @throws InvalidInput with these words if `count` exceeds `most`
inline void requireAtMost(std::int64_t most, std::int64_t count, const char* function, const char* what) {
  if (count <= most) return;
  throw InvalidInput(std::string(function) + ": " + std::to_string(count) + " " + what + ", must be at most " +
                     std::to_string(most));
}

/// Checks that a choice between methods is one of its type's values, which another integer may be cast to.
/// @param last the last of these values
/// @throws InvalidInput with the name of the argument if it is not
template <class Choice>
void requireChoice(Choice choice, Choice last, const std::string& function, const char* name) {
  const auto number = static_cast<int>(choice);
  if (number >= 0 && number <= static_cast<int>(last)) return;
  throw InvalidInput(function + ": " + name + " = " + std::to_string(number) + ", must lie in [0, " +
                     std::to_string(static_cast<int>(last)) + "]");
}

}  // namespace tufted
