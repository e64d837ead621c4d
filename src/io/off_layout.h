#pragma once

#include <cstddef>

namespace tufted::io {

/// Which values each vertex has by the keyword [ST][C][N][4]OFF: x y z [w] [nx ny nz] [colour] [texture].
struct OffLayout {
  bool texture = false;
  bool colors = false;
  bool normals = false;
  bool homogeneous = false;

  /// Index among a vertex's values of the first one of the normal, and of the first one after it.
  std::size_t normal() const { return homogeneous ? 4 : 3; }
  std::size_t behindNormal() const { return normal() + (normals ? 3 : 0); }
};

}  // namespace tufted::io
