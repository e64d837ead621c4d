#pragma once

#include <pybind11/pybind11.h>

// What each file of this folder adds to the module `_tufted`. The package `tufted` checks arguments and gives them the
// types that these functions take, so only it calls them.
namespace tufted::python {

void addErrors(pybind11::module_& module);
void addLaplacian(pybind11::module_& module);
void addPickling(pybind11::module_& module);
void addSpectrum(pybind11::module_& module);
void addDistance(pybind11::module_& module);
void addInterpolation(pybind11::module_& module);
void addVectorHeat(pybind11::module_& module);
void addShape(pybind11::module_& module);
void addMoving(pybind11::module_& module);
void addOperators(pybind11::module_& module);
void addFiles(pybind11::module_& module);
void addView(pybind11::module_& module);

}  // namespace tufted::python
