#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <string>
#include <string_view>

#include "tufted/errors.h"
#include "tufted/options.h"

namespace tufted::python {

/// Checks between the steps of a computation whether Ctrl-C was pressed, and calls the caller's `progress`.
class Watcher {
 public:
  /// @param callable called with stage and fraction, or None; stops the computation by returning False or by raising
  explicit Watcher(pybind11::object callable) : callable_(std::move(callable)) {}

  /// A callback for the library, which borrows the watcher.
  Progress progress() {
    return [this](std::string_view stage, double fraction) { return mayGoOn(stage, fraction); };
  }

  /// Throws the exception that Python raised during the computation, if any.
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

/// Runs a computation without holding Python's lock, so that other threads of the program can run.
/// @param progress the caller's `progress`, or None
/// @param compute takes a Progress; must not touch objects of Python
/// @return what `compute` returns
/// @throws what `progress` or Ctrl-C raised, or what `compute` throws
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
