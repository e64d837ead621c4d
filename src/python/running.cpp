#include "python/running.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

/// Least time between two checks for Ctrl-C and calls of `progress`, except at a new stage. Each needs Python's lock,
/// for which it may wait as long as another thread holds it.
constexpr std::chrono::milliseconds pause(50);

}  // namespace

bool Watcher::mayGoOn(std::string_view stage, double fraction) {
  const auto now = std::chrono::steady_clock::now();
  const bool is_new_stage = !callable_.is_none() && stage != stage_;
  if (raised_ || (!is_new_stage && now - last_ < pause)) return !raised_;
  last_ = now;
  const py::gil_scoped_acquire acquire;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (callable_.is_none()) return true;
    stage_ = stage;
    return !callable_(py::str(stage_), fraction).is(py::bool_(false));
  } catch (const py::error_already_set&) {
    raised_ = std::current_exception();
    return false;
  }
}

}  // namespace tufted::python
