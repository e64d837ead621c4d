#pragma once

#include <stdexcept>
#include <string>

namespace tufted {

/// A caller's mistake. The message names the function, the value and the rule it breaks.
struct InvalidInput : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// A system that could not be solved although the arguments are valid: not positive definite, no convergence, overflow,
/// or too little memory. The message says what to change.
struct SolverFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The progress callback asked to stop.
struct Cancelled : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file that cannot be read or written. The message names the path and, where known, the line or byte.
struct IoError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file that may be valid but whose content does not fit into memory.
struct FileTooLarge : IoError {
  using IoError::IoError;
};

}  // namespace tufted
