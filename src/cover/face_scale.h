#pragma once

#include "tufted/types.h"

namespace tufted {

/// The factor of each face in L and in areas (section 12 of docs/algorithm.md): the cover has front and back, and on
/// clouds each triangle is found by its three corners.
constexpr double faceScale(Kind kind) {
  return kind == Kind::cloud ? 1.0 / 2 / 3 : 1.0 / 2;
}

}  // namespace tufted
