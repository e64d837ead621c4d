#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "cover/geometry.h"

namespace tufted {

/// Visits all faces, in any order.
template <class Visit>
void forEachFace(std::int64_t faces, const Workers& workers, const Visit& visit) {
  workers.forBlocks("assemble", faces, cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (int f = static_cast<int>(begin); f < end; ++f) visit(f);
  });
}

/// The area of every face of an IntrinsicTriangulation or a CoverBuffer.
template <class Triangulation>
Buffer<double> faceAreas(const Triangulation& t, const Workers& workers) {
  Buffer<double> areas(static_cast<std::size_t>(t.size()));
  forEachFace(std::ssize(areas), workers, [&](int f) { areas[f] = faceArea(t, f); });
  return areas;
}

/// The cotangent, or 0 if it is infinite or NaN: a face without area adds nothing to L.
inline double finiteCotan(double cotan) {
  return std::isfinite(cotan) ? cotan : 0;
}

/// The finite cotangent opposite `side`, by faceAreas().
template <class Triangulation>
double finiteCotan(const Triangulation& t, const Buffer<double>& areas, int side) {
  return finiteCotan(cotanNumerator(t.length[side], t.length[nextSide(side)], t.length[previousSide(side)]) /
                     (4 * areas[side / 3]));
}

}  // namespace tufted
