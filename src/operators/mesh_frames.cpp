// meshFrames(): tangent frames of a mesh's vertices.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
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

/// A triangle whose height is at most this part of its coordinates has a normal of rounding alone.
constexpr double flat_height = 8 * std::numeric_limits<double>::epsilon();

/// Gives vertices without a normal, as all of their triangles are flat, the moments and sums of their neighbours, ring
/// by ring.
void spreadToFlat(const TrianglesRef& triangles, std::vector<Eigen::Matrix3d>& moments, Points& sums) {
  const auto isKnown = [&](int i) { return moments[i].trace() != 0; };  // or not finite
  std::map<int, std::vector<int>> neighbors;                            // of vertices that are not known
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      if (const int i = triangles(f, k); !isKnown(i))
        for (const int j : {triangles(f, (k + 1) % 3), triangles(f, (k + 2) % 3)}) neighbors[i].push_back(j);
  std::set<int> ring;
  for (const auto& [i, around] : neighbors)
    if (std::any_of(around.begin(), around.end(), isKnown)) ring.insert(i);
  while (!ring.empty()) {
    std::vector<std::pair<Eigen::Matrix3d, Eigen::RowVector3d>> found;
    std::set<int> next;
    for (const int i : ring) {
      found.emplace_back(Eigen::Matrix3d::Zero(), Eigen::RowVector3d::Zero());
      for (const int j : neighbors[i]) {
        found.back().first += moments[j];
        found.back().second += sums.row(j);
        if (!isKnown(j) && ring.count(j) == 0) next.insert(j);
      }
    }
    std::size_t at = 0;
    for (const int i : ring) {
      moments[i] = found[at].first;
      sums.row(i) = found[at++].second;
    }
    ring = std::move(next);
  }
}

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
    const double coordinate =
        std::max({a.cwiseAbs().maxCoeff(), (a + u).cwiseAbs().maxCoeff(), (a + v).cwiseAbs().maxCoeff()});
    // The normal, as long as twice the area over `size`, as the area itself may underflow.
    const Eigen::RowVector3d normal = (u / size).cross(v / size) * size;
    const double weight = normal.stableNorm();
    if (!(weight > flat_height * coordinate)) continue;
    for (int k = 0; k < 3; ++k) {
      moments[triangles(f, k)] += normal.transpose() * (normal / weight);
      sums.row(triangles(f, k)) += normal;
      directed.push_back(static_cast<std::uint64_t>(triangles(f, k)) << 32U |
                         static_cast<std::uint64_t>(triangles(f, (k + 1) % 3)));
    }
  }
  spreadToFlat(triangles, moments, sums);
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
