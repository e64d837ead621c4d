#pragma once

#include <pybind11/pybind11.h>

// Each file of this folder adds its functions to the module `_tufted`. Only the package `tufted` calls them: it checks
// arguments and converts them to the types that they take.
namespace tufted::python {

void addErrors(pybind11::module_& module);
void addLaplacian(pybind11::module_& module);
void addPickling(pybind11::module_& module);
void addSpectrum(pybind11::module_& module);
void addDistance(pybind11::module_& module);
void addInterpolation(pybind11::module_& module);
void addVectorHeat(pybind11::module_& module);
void addShape(pybind11::module_& module);
void addShapeMaps(pybind11::module_& module);
void addMoving(pybind11::module_& module);
void addOperators(pybind11::module_& module);
void addFiles(pybind11::module_& module);
void addTiles(pybind11::module_& module);
void addView(pybind11::module_& module);

}  // namespace tufted::python
