#include "tufted/errors.h"

#include <array>
#include <string>
#include <utility>

#include "python/module.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

struct Name {
  const char* cpp;
  const char* python;
};

/// Words within the library's messages, and their names in Python.
constexpr std::array words = {
    Name{"pins.points", "pins"},
    Name{"pins.values", "values"},
    Name{"SegmentMethod::spectral", "method 'spectral'"},
    Name{"SegmentMethod::parts", "method 'parts'"},
    Name{"ParameterizationMethod::harmonic", "method 'harmonic'"},
    Name{"SolverMethod::cholesky", "'cholesky'"},
    Name{"SolverMethod::multigrid", "'multigrid'"},
    Name{"set method to", "set solver to"},
    Name{"structure.origin", "viewpoint"},
    Name{"structure.position", "rings"},
    Name{"componentMeans", "filter"},
};

/// A message of the library with the names of Python. The function that it begins with is named by the package.
std::string inPython(const char* message) {
  std::string text = message;
  for (const Name& name : words) {
    const std::string from = name.cpp, to = name.python;
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  }
  return text;
}

/// Exception classes of Python, which live as long as the interpreter.
PyObject *invalid_input, *io_error, *file_too_large, *solver_failure, *cancelled;

PyObject* addError(py::module_& module, const char* name, PyObject* base, const char* doc) {
  const std::string full_name = std::string("tufted.") + name;
  PyObject* const type = PyErr_NewExceptionWithDoc(full_name.c_str(), doc, base, nullptr);
  if (type == nullptr) throw py::error_already_set();
  module.add_object(name, type);
  return type;
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(std::move(pointer));
  } catch (const InvalidInput& error) {
    PyErr_SetString(invalid_input, inPython(error.what()).c_str());
  } catch (const FileTooLarge& error) {
    PyErr_SetString(file_too_large, error.what());
  } catch (const IoError& error) {
    PyErr_SetString(io_error, error.what());
  } catch (const SolverFailure& error) {
    PyErr_SetString(solver_failure, inPython(error.what()).c_str());
  } catch (const Cancelled& error) {
    PyErr_SetString(cancelled, inPython(error.what()).c_str());
  }
}

}  // namespace

void addErrors(py::module_& module) {
  invalid_input = addError(module, "InvalidInput", PyExc_ValueError,
                           "A mistake of the caller. The message names the function, the argument, its value and the "
                           "rule that it breaks.");
  io_error = addError(module, "IoError", PyExc_OSError,
                      "A file that cannot be read or written. The message names the path and, where known, the line or "
                      "byte.");
  file_too_large = addError(module, "FileTooLarge", io_error,
                            "A file that may be valid but whose content does not fit into memory.");
  solver_failure = addError(module, "SolverFailure", PyExc_RuntimeError,
                            "A system that could not be solved although the arguments are valid. The message says "
                            "what to change.");
  cancelled = addError(module, "Cancelled", PyExc_RuntimeError, "The callback `progress` returned False.");
  py::register_exception_translator(translate);
}

}  // namespace tufted::python
