#include "shapes/mesh_builder.h"

#include <utility>

namespace tufted::shapes {

int MeshBuilder::add(const Eigen::Vector3d& point) {
  points_.push_back(point);
  return static_cast<int>(points_.size()) - 1;
}

int MeshBuilder::weld(const Eigen::Vector3d& point) {
  for (const int i : welded_) {
    if ((points_[i] - point).squaredNorm() < 1e-18) return i;
  }
  welded_.push_back(add(point));
  return welded_.back();
}

void MeshBuilder::polygon(std::vector<int> corners) {
  for (std::size_t k = 2; k < corners.size(); ++k) triangle(corners[0], corners[k - 1], corners[k]);
  polygons_.push_back(std::move(corners));
}

void MeshBuilder::grid(int columns, int rows, const std::function<int(int, int)>& vertex) {
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      triangle(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      triangle(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  }
}

void MeshBuilder::strip(const std::vector<int>& right, const std::vector<int>& left, Quality quality) {
  std::size_t i = 0, j = 0;
  while (i + 1 < right.size() || j + 1 < left.size()) {
    bool advance_right = i + 1 < right.size();
    if (quality == Quality::good && advance_right && j + 1 < left.size()) {
      advance_right = (points_[right[i + 1]] - points_[left[j]]).squaredNorm() <=
                      (points_[right[i]] - points_[left[j + 1]]).squaredNorm();
    }
    if (advance_right) {
      triangle(right[i], right[i + 1], left[j]);
      ++i;
    } else {
      triangle(right[i], left[j + 1], left[j]);
      ++j;
    }
  }
}

void MeshBuilder::stripPolygons(const std::vector<int>& right, const std::vector<int>& left) {
  for (std::size_t i = 0; i + 1 < right.size(); ++i) {
    if (i + 1 < left.size()) {
      polygon({right[i], right[i + 1], left[i + 1], left[i]});
    } else {
      polygon({right[i], right[i + 1], left[i]});
    }
  }
}

void MeshBuilder::append(const Mesh& mesh, const Eigen::Vector3d& offset) {
  const int first = static_cast<int>(points_.size());
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i) add(mesh.points.row(i).transpose() + offset);
  for (Eigen::Index i = 0; i < mesh.triangles.rows(); ++i) {
    triangle(first + mesh.triangles(i, 0), first + mesh.triangles(i, 1), first + mesh.triangles(i, 2));
  }
}

Mesh MeshBuilder::finish(const std::string& shape) const {
  Mesh mesh{.name = shape,
            .shape = shape,
            .points = Points(points_.size(), 3),
            .triangles = Triangles(triangles_.size(), 3),
            .polygons = polygons_};
  for (std::size_t i = 0; i < points_.size(); ++i) mesh.points.row(i) = points_[i].transpose();
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (int k = 0; k < 3; ++k) mesh.triangles(i, k) = triangles_[i][k];
  }
  return mesh;
}

}  // namespace tufted::shapes
