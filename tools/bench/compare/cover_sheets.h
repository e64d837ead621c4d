#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "bench/compare/cover_lines.h"
#include "cover/geometry.h"

namespace tufted::bench {

/// The mesh as its cover lies around it: fronts and backs moved apart along the normals.
class Sheets {
 public:
  /// @param apart distance from the triangle to its front and to its back
  /// @param shrunk size of the drawn triangles relative to their own
  Sheets(const Points& points, const IntrinsicTriangulation& cover, double apart, double shrunk)
      : points_(points), cover_(cover), apart_(apart), shrunk_(shrunk) {}

  /// From a triangle of the mesh to its front or back.
  Eigen::Vector3d shift(int face) const {
    const auto& [i, j, k] = cover_.faces[static_cast<std::size_t>(face)];
    const Eigen::Vector3d a = points_.row(i), b = points_.row(j), c = points_.row(k);
    return apart_ * (b - a).cross(c - a).normalized();  // the corners of a back run the other way
  }
  /// The middle of a drawn face.
  Eigen::Vector3d middle(int face) const {
    const auto& [i, j, k] = cover_.faces[static_cast<std::size_t>(face)];
    return Eigen::Vector3d(points_.row(i) + points_.row(j) + points_.row(k)) / 3 + shift(face);
  }
  /// The corner of a drawn face at which a side begins.
  Eigen::Vector3d corner(int side) const {
    const Eigen::Vector3d at = points_.row(tail(cover_, side)), around = middle(side / 3);
    return around + shrunk_ * (at + shift(side / 3) - around);
  }
  /// The corners of a drawn face.
  std::vector<Eigen::Vector3d> corners(int face) const {
    return {corner(3 * face), corner(3 * face + 1), corner(3 * face + 2)};
  }
  /// The quadrilateral between a side and the one that it is glued to.
  std::vector<Eigen::Vector3d> band(int side) const {
    const int mate = cover_.glue[static_cast<std::size_t>(side)];
    return {corner(side), corner(nextSide(side)), corner(mate), corner(nextSide(mate))};
  }

  /// Far apart and shrunk, so that one sees what is glued. The size is that of an edge.
  static Sheets apart(const Points& points, const IntrinsicTriangulation& cover, double size) {
    return {points, cover, 0.07 * size, 0.85};
  }
  /// Close together, so that lines on them seem to lie on the mesh.
  static Sheets close(const Points& points, const IntrinsicTriangulation& cover, double size) {
    return {points, cover, 0.03 * size, 1};
  }

 private:
  const Points& points_;
  const IntrinsicTriangulation& cover_;
  double apart_, shrunk_;
};

/// Writes a page for any browser: the cover with the bands between glued sides, and beside it the intrinsic edges.
/// @param size the mean length of an edge
/// @throws IoError
void writeCoverPage(const Points& points, const IntrinsicTriangulation& cover, const IntrinsicEdges& found, double size,
                    const std::filesystem::path& path);

}  // namespace tufted::bench
