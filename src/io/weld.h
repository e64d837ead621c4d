#pragma once

#include "tufted/io/read.h"

namespace tufted::io {

/// Gives equal corners of a soup of triangles one number, in the order in which they come, and counts the others as
/// `merged_vertices`. Corners that are not finite stay apart.
/// @param geometry a mesh with points and triangles only
void weld(Geometry& geometry);

}  // namespace tufted::io
