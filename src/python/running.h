#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <string>
#include <string_view>

#include "tufted/errors.h"
#include "tufted/options.h"

namespace tufted::python {

/// Between steps of a computation, looks whether Ctrl-C was pressed, and calls the caller's `progress`.
class Watcher {
 public:
  /// @param callable called with stage and fraction; None: nothing is called. It stops the computation by returning
  /// False or by raising.
  explicit Watcher(pybind11::object callable) : callable_(std::move(callable)) {}

  /// To be handed to the library; borrows the watcher.
  Progress progress() {
    return [this](std::string_view stage, double fraction) { return mayGoOn(stage, fraction); };
  }

  /// Throws what Python raised in between, if anything.
  void rethrow() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  bool mayGoOn(std::string_view stage, double fraction);

  pybind11::object callable_;
  std::string stage_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::exception_ptr raised_;
};

/// Runs a computation without holding Python's lock, so that other threads of the program go on.
/// @param progress the caller's `progress`, or None
/// @param compute takes a Progress; must not touch Python's objects
template <class Compute>
auto run(const pybind11::object& progress, const Compute& compute) {
  Watcher watcher(progress);
  try {
    const pybind11::gil_scoped_release release;
    return compute(watcher.progress());
  } catch (const Cancelled&) {
    watcher.rethrow();
    throw;
  }
}

}  // namespace tufted::python
