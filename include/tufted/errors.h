#pragma once

#include <stdexcept>
#include <string>

namespace tufted {

/// A caller's mistake. The message names the function, the value and the rule it breaks.
struct InvalidInput : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// A matrix that could not be factorised, though nothing is wrong with the arguments by themselves.
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

/// A file that may be good, but its content does not fit into the memory.
struct FileTooLarge : IoError {
  using IoError::IoError;
};

}  // namespace tufted
