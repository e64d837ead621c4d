#pragma once

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <vector>

#include "shapes/random.h"
#include "shapes/shapes.h"

namespace tufted::shapes {

/// Collects points and triangles in growing lists.
class MeshBuilder {
 public:
  int add(const Eigen::Vector3d& point);
  /// The index of an earlier point of this function within 1e-9, or a new one.
  int weld(const Eigen::Vector3d& point);
  void triangle(int a, int b, int c) { triangles_.push_back({a, b, c}); }
  /// A polygon and its fan triangulation.
  void polygon(std::vector<int> corners);
  /// columns x rows cells of two triangles each; vertex(i, j) names the corners.
  void grid(int columns, int rows, const std::function<int(int, int)>& vertex);
  /// Triangles between two rows of points that run the same way, the second one to the left of the first.
  void strip(const std::vector<int>& right, const std::vector<int>& left, Quality quality);
  /// Quadrilaterals between two rows of points as in strip(), and a triangle where the left row is shorter.
  void stripPolygons(const std::vector<int>& right, const std::vector<int>& left);
  /// Adds another mesh, moved by `offset`.
  void append(const Mesh& mesh, const Eigen::Vector3d& offset);

  /// Points, triangles and polygons; the caller fills in the truth.
  Mesh finish(const std::string& shape) const;

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<int> welded_;
  std::vector<std::array<int, 3>> triangles_;
  Polygons polygons_;
};

}  // namespace tufted::shapes
