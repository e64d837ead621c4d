#pragma once

#include <cstddef>

namespace tufted::io {

/// What the keyword [ST][C][N][4]OFF says about a vertex: x y z [w] [nx ny nz] [colour] [texture].
struct OffLayout {
  bool texture = false;
  bool colors = false;
  bool normals = false;
  bool homogeneous = false;

  /// Number of the first value of the normal, and of what follows it.
  std::size_t normal() const { return homogeneous ? 4 : 3; }
  std::size_t behindNormal() const { return normal() + (normals ? 3 : 0); }
};

}  // namespace tufted::io
