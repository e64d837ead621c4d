#pragma once

#include <cstddef>
#include <vector>

#include "algorithms/march_faces.h"
#include "algorithms/march_update.h"

// What a march sees of the faces: vertices by number and the triangles around each.

namespace tufted {

/// The faces as triangles, not cut.
struct WholeFaces {
  const MarchFaces& faces;

  std::size_t size() const { return static_cast<std::size_t>(faces.vertices); }
  Eigen::Vector3d position(int a) const { return faces.positions[a]; }

  template <class Visit>
  void around(int a, const Visit& visit) const {
    for (int s = faces.corner_offset[a]; s < faces.corner_offset[a + 1]; ++s) {
      const MarchFace& face = faces.faces[faces.corner_slots[s] / 3];
      const int k = faces.corner_slots[s] % 3, i = (k + 1) % 3, j = (k + 2) % 3;
      visit(MarchTriangle{face.corners[i], face.corners[j], face.opposite[j], face.opposite[i], face.opposite[k],
                          face.doubleArea(), face.isBent()});
    }
  }
};

/// The four triangles into which each face is cut at the midpoints of its sides.
struct SplitFaces {
  const MarchFaces& faces;

  std::size_t size() const { return static_cast<std::size_t>(faces.vertices) + faces.edges; }
  Eigen::Vector3d position(int a) const {
    return a < faces.vertices ? faces.positions[a] : faces.middleOf(a - faces.vertices);
  }

  template <class Visit>
  void around(int a, const Visit& visit) const {
    const int n = faces.vertices;
    const bool is_middle = a >= n;
    const std::vector<int>&offset = is_middle ? faces.edge_offset : faces.corner_offset,
          &slots = is_middle ? faces.edge_slots : faces.corner_slots;
    const int first = is_middle ? offset[a - n] : offset[a], last = is_middle ? offset[a - n + 1] : offset[a + 1];
    for (int s = first; s < last; ++s) {
      const MarchFace& face = faces.faces[slots[s] / 3];
      const int k = slots[s] % 3, i = (k + 1) % 3, j = (k + 2) % 3;
      const double side_i = face.opposite[i] / 2, side_j = face.opposite[j] / 2, side_k = face.opposite[k] / 2;
      const double double_area = face.doubleArea() / 4;
      const int middle_i = n + face.edges[i], middle_j = n + face.edges[j];
      if (is_middle) {
        visit(MarchTriangle{face.corners[i], middle_j, side_k, side_i, side_j, double_area, face.isBent()});
        visit(MarchTriangle{face.corners[j], middle_i, side_k, side_j, side_i, double_area, face.isBent()});
        visit(MarchTriangle{middle_i, middle_j, side_j, side_i, side_k, double_area, face.isBent()});
      } else {
        visit(MarchTriangle{middle_j, middle_i, side_j, side_i, side_k, double_area, face.isBent()});
      }
    }
  }
};

}  // namespace tufted
