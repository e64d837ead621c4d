#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "cloud/stars.h"

namespace tufted {

/// Which points do not agree with those around them, n flags by rank.
///
/// A point p agrees when its star is closed and lost nothing, every link vertex has p in its own link between the same
/// two neighbours, and no other star has p in its link. Then each edge at p lies in two triangles, of which all three
/// stars have a copy, and the cover around p is known from its star: with Gluing::star all copies of an edge have two
/// faces, and front and back mirror each other.
Buffer<std::uint8_t> findDisagreement(const Stars& stars, const Workers& workers);

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

}  // namespace tufted
