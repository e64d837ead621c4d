#include <algorithm>

#include "shapes/spectra.h"

namespace tufted::shapes {

VectorXd cubeSpectrum(int count) {
  return VectorXd(std::min(count, 0));
}

}  // namespace tufted::shapes
