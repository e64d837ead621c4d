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
  /// Returns the index of a point that this function added within 1e-9, or adds a new one.
  int weld(const Eigen::Vector3d& point);
  void triangle(int a, int b, int c) { triangles_.push_back({a, b, c}); }
  /// Adds a polygon and its fan triangulation.
  void polygon(std::vector<int> corners);
  /// Adds columns x rows cells of two triangles each, with the corners vertex(i, j).
  void grid(int columns, int rows, const std::function<int(int, int)>& vertex);
  /// Adds triangles between two rows of points in the same direction, the second one to the left of the first.
  void strip(const std::vector<int>& right, const std::vector<int>& left, Quality quality);
  /// Adds quadrilaterals between two rows of points as in strip(), and a triangle if the left row is shorter.
  void stripPolygons(const std::vector<int>& right, const std::vector<int>& left);
  /// Adds another mesh, moved by `offset`.
  void append(const Mesh& mesh, const Eigen::Vector3d& offset);

  /// The mesh, without what is known of its shape, which the caller adds.
  Mesh finish(const std::string& shape) const;

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<int> welded_;
  std::vector<std::array<int, 3>> triangles_;
  Polygons polygons_;
};

}  // namespace tufted::shapes
