// meshFrames(): tangent frames of a mesh's vertices.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/symmetric_eigen.h"
#include "operators/corners_in_range.h"
#include "stars/tangent_frame.h"
#include "tufted/check.h"
#include "tufted/errors.h"
#include "tufted/gradient.h"

namespace tufted {
namespace {

constexpr const char* mesh_frames_name = "meshFrames";

/// Whether triangles are consistently oriented: no two have an edge in the same direction.
/// @param directed edges of all triangles, each from its first to its second corner; overwritten
bool agree(std::vector<std::uint64_t>& directed) {
  std::sort(directed.begin(), directed.end());
  return std::adjacent_find(directed.begin(), directed.end()) == directed.end();
}

}  // namespace

Frames meshFrames(const PointsRef& points, const TrianglesRef& triangles) {
  requireCornersInRange(mesh_frames_name, triangles, points.rows());
  std::vector<Eigen::Matrix3d> moments(points.rows(), Eigen::Matrix3d::Zero());
  Points sums = Points::Zero(points.rows(), 3);
  std::vector<std::uint64_t> directed;
  directed.reserve(3 * static_cast<std::size_t>(triangles.rows()));
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Eigen::RowVector3d a = points.row(triangles(f, 0));
    const Eigen::RowVector3d u = points.row(triangles(f, 1)) - a, v = points.row(triangles(f, 2)) - a;
    const double size = std::max(u.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff());
    if (!(size > 0) || !std::isfinite(size)) continue;
    // The normal, as long as twice the area over `size`, as the area itself may underflow.
    const Eigen::RowVector3d normal = (u / size).cross(v / size) * size;
    const double weight = normal.stableNorm();
    if (!(weight > 0)) continue;
    for (int k = 0; k < 3; ++k) {
      moments[triangles(f, k)] += normal.transpose() * (normal / weight);
      sums.row(triangles(f, k)) += normal;
      directed.push_back(static_cast<std::uint64_t>(triangles(f, k)) << 32U |
                         static_cast<std::uint64_t>(triangles(f, (k + 1) % 3)));
    }
  }
  Frames frames{Points(points.rows(), 3), Points(points.rows(), 3),
                agree(directed) ? Orientation::given : Orientation::arbitrary};
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
    const double scale = moments[i].trace();
    if (scale > 0) {
      normal = symmetricEigen(Eigen::Matrix3d(moments[i] / scale)).eigenvectors().col(2);
      if (normal.dot(sums.row(i)) < 0) normal = -normal;
    }
    frames.normals.row(i) = normal;
    frames.tangents.row(i) = tangentOf(normal);
  }
  return frames;
}

Frames meshFrames(const Laplacian& laplacian, const PointsRef& points, const TrianglesRef& triangles) {
  checkSizes(mesh_frames_name, laplacian);
  if (points.rows() != std::ssize(laplacian.status))
    throw InvalidInput(std::string(mesh_frames_name) + ": points has " + std::to_string(points.rows()) +
                       " rows, must have " + std::to_string(laplacian.status.size()) + ", as the Laplacian");
  requireCornersInRange(mesh_frames_name, triangles, points.rows());
  Triangles joined = triangles;
  for (int& corner : joined.reshaped()) corner = laplacian.representative[corner];
  Frames frames = meshFrames(points, joined);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    frames.normals.row(i) = frames.normals.row(laplacian.representative[i]);
    frames.tangents.row(i) = frames.tangents.row(laplacian.representative[i]);
  }
  return frames;
}

}  // namespace tufted
