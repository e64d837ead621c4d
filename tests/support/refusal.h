#pragma once

#include <string>

#include "tufted/errors.h"

namespace tufted::support {

/// The message of the InvalidInput that a call throws, or "accepted".
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
