#pragma once

#include <string>

#include "tufted/errors.h"

namespace tufted::support {

/// What InvalidInput says when a call is refused, "accepted" when it is not.
template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace tufted::support
