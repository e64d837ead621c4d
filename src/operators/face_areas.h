#pragma once

#include <cmath>
#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "intrinsic/geometry.h"

namespace tufted {

/// Of every face of an IntrinsicTriangulation or a CoverBuffer.
template <class Triangulation>
Buffer<double> faceAreas(const Triangulation& t, const Workers& workers) {
  constexpr std::int64_t block_size = 8192;
  Buffer<double> areas(static_cast<std::size_t>(t.size()));
  workers.forBlocks("assemble", std::ssize(areas), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (int f = static_cast<int>(begin); f < end; ++f) areas[f] = faceArea(t, f);
  });
  return areas;
}

/// A face of no area has no cotangents and adds nothing.
inline double finiteCotan(double cotan) {
  return std::isfinite(cotan) ? cotan : 0;
}

/// The cotangent opposite `side`, from the areas of the faces.
template <class Triangulation>
double finiteCotan(const Triangulation& t, const Buffer<double>& areas, int side) {
  return finiteCotan(cotanNumerator(t.length[side], t.length[nextSide(side)], t.length[previousSide(side)]) /
                     (4 * areas[side / 3]));
}

/// Three lengths per face become the cotangents of the angles opposite. Returns the areas.
inline Buffer<double> toCotans(Buffer<double>& lengths, const Workers& workers) {
  constexpr std::int64_t block_size = 8192;
  Buffer<double> areas(lengths.size() / 3);
  workers.forBlocks("assemble", std::ssize(areas), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto f = static_cast<std::size_t>(begin); f < static_cast<std::size_t>(end); ++f) {
      double* const side = lengths.data() + 3 * f;
      const double a = side[0], b = side[1], c = side[2];
      areas[f] = triangleArea(a, b, c);
      side[0] = finiteCotan(cotanNumerator(a, b, c) / (4 * areas[f]));
      side[1] = finiteCotan(cotanNumerator(b, c, a) / (4 * areas[f]));
      side[2] = finiteCotan(cotanNumerator(c, a, b) / (4 * areas[f]));
    }
  });
  return areas;
}

}  // namespace tufted
