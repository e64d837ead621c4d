#include "python/module.h"

#include "tufted/options.h"
#include "tufted/version.h"

PYBIND11_MODULE(_tufted, module) {  // NOLINT
  using namespace tufted::python;
  module.doc() = "The library behind the package tufted, which checks arguments before it calls what is here.";
  module.attr("version") = TUFTED_VERSION;
  module.attr("default_mollify") = tufted::default_mollify;
  addErrors(module);
  addLaplacian(module);
  addPickling(module);
  addSpectrum(module);
  addDistance(module);
  addInterpolation(module);
  addVectorHeat(module);
  addShape(module);
  addShapeMaps(module);
  addMoving(module);
  addOperators(module);
  addFiles(module);
  addTiles(module);
  addView(module);
}
