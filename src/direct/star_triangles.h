#pragma once

#include "base/buffer.h"
#include "cover/cover.h"
#include "stars/stars.h"

namespace tufted {

// Numbers and gluing of the triangles of a star in a cover of the union of stars.

/// The number of triangles of star p before link entry i.
inline int trianglesBefore(const Stars& stars, int p, int i) {
  int count = 0;
  for (int j = stars.offset[p]; j < i; ++j) count += stars.hasTriangle(j) ? 1 : 0;
  return count;
}

inline int triangleCount(const Stars& stars, int p) {
  return trianglesBefore(stars, p, stars.offset[p + 1]);
}

/// n + 1: the first triangle of each star, and the number of all.
inline Buffer<int> firstTriangles(const Stars& stars) {
  Buffer<int> first(static_cast<std::size_t>(stars.size()) + 1);
  for (int p = 0; p < stars.size(); ++p) first[p + 1] = first[p] + triangleCount(stars, p);
  return first;
}

/// Glues the faces of star p across each spoke between two triangles, front to front and back to back.
/// @param first its first triangle; the others follow in the order of the link
template <class Triangulation>
void glueSpokes(const Stars& stars, int p, int first, Triangulation& cover) {
  // Triangle (p, a, v) has the spoke v p as side 2, triangle (p, v, b) as side 0.
  const auto glue = [&](int before, int after) {
    glueSides(cover, frontSide(before, 2), frontSide(after, 0));
    glueSides(cover, backSide(before, 2), backSide(after, 0));
  };
  int t = first, previous = -1, at_begin = -1;
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
    if (!stars.hasTriangle(i)) {
      previous = -1;
      continue;
    }
    if (i == stars.offset[p]) at_begin = t;
    if (previous >= 0) glue(previous, t);
    previous = t++;
  }
  if (previous >= 0 && at_begin >= 0) glue(previous, at_begin);
}

}  // namespace tufted
