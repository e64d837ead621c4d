#pragma once

#include <string>

#include "tufted/errors.h"

namespace tufted::support {

/// The message of the Error that a call throws, or "accepted".
template <class Error = InvalidInput, class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace tufted::support
