#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "stars/stars.h"

namespace tufted {

/// Which points do not agree with those around them, n flags by rank.
///
/// A point p agrees when its star is closed and lost nothing, every link vertex has p in its own link between the same
/// two neighbours, and no other star has p in its link. Then each edge at p lies in two triangles, of which all three
/// stars have a copy, and the cover around p is known from its star: with Gluing::star all copies of an edge have two
/// faces, and front and back mirror each other.
/// @param among n flags of the points that may not agree; empty: all
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

/// The neighbours of link vertex i of star p in the link, if there is a triangle towards both.
struct Sides {
  int left = -1, right = -1;

  Sides(const Stars& stars, int p, int i) {
    const int previous = before(stars, p, i);
    if (stars.hasTriangle(previous)) left = stars.link[previous];
    if (stars.hasTriangle(i)) right = stars.link[stars.after(p, i)];
  }
  bool has(int q) const { return q == left || q == right; }
  bool areWhole() const { return left >= 0 && right >= 0; }
  /// Either way round: the sign of normals is arbitrary.
  bool areThoseOf(const Sides& other) const {
    return (left == other.left && right == other.right) || (left == other.right && right == other.left);
  }
};

}  // namespace tufted
