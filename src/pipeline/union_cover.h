#pragma once

#include "base/parallel.h"
#include "stars/stars.h"
#include "tufted/intrinsic_triangulation.h"
#include "tufted/options.h"

namespace tufted {

/// Makes the union of all stars, front and back of every copy of a triangle. With `Gluing::star` glues the two faces of
/// a star at a spoke, front to front and back to back.
void addStars(const Stars& stars, Gluing gluing, IntrinsicTriangulation& cover, const Workers& workers);

}  // namespace tufted
