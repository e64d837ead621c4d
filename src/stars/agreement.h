#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "stars/stars.h"

namespace tufted {

/// Finds the points that do not agree with their neighbours (section 7 of docs/algorithm.md): n flags by rank, 1 if
/// not.
///
/// A point p agrees if its star is closed and lost no triangle, every link vertex has p in its own link between the
/// same two neighbours, and no other star has p in its link. Then each edge at p lies in two triangles, of which all
/// three stars have a copy, and the cover around p is known from its star: with Gluing::star all copies of an edge have
/// two faces, and front and back mirror each other.
/// @param among n flags; only points with flag 1 are tested. Empty: all points
Buffer<std::uint8_t> findDisagreement(const Stars& stars, const Workers& workers,
                                      const Buffer<std::uint8_t>& among = {});

/// The link entry of star p that holds q, or -1.
inline int entryOf(const Stars& stars, int p, int q) {
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i)
    if (stars.link[i] == q) return i;
  return -1;
}

/// The link entry before i in star p, cyclically.
inline int before(const Stars& stars, int p, int i) {
  return i == stars.offset[p] ? stars.offset[p + 1] - 1 : i - 1;
}

/// The two neighbours of link vertex i in the link of p; -1 on a side without a triangle.
struct Sides {
  int left = -1, right = -1;

  Sides(const Stars& stars, int p, int i) {
    const int previous = before(stars, p, i);
    if (stars.hasTriangle(previous)) left = stars.link[previous];
    if (stars.hasTriangle(i)) right = stars.link[stars.after(p, i)];
  }
  bool has(int q) const { return q == left || q == right; }
  bool areWhole() const { return left >= 0 && right >= 0; }
  /// Whether both have the same neighbours, in either order, because the sign of normals is arbitrary.
  bool areThoseOf(const Sides& other) const {
    return (left == other.left && right == other.right) || (left == other.right && right == other.left);
  }
};

}  // namespace tufted
