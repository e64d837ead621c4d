// Gradients at points by least squares in tangent planes (DiffusionNet; Sharp et al. 2022, Section 3.4).
#include "tufted/gradient.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "stars/tangent_frame.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// A neighbourhood has two spreads in its tangent plane; the smaller counts as 0 below this part of the larger.
constexpr double flat = 1e-10;
/// If the smaller spread is below this part of the larger, the neighbours of the neighbours are used as well, as the
/// neighbours alone hardly determine the slope across.
constexpr double narrow = 1e-4;

void checkArguments(const Laplacian& laplacian, const Points& points, const Frames& frames) {
  checkSizes("gradients", laplacian);
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  const auto check = [&](const char* name, Eigen::Index rows) {
    if (rows != n) {
      throw InvalidInput("gradients: " + std::string(name) + " has " + std::to_string(rows) + " rows, must have " +
                         std::to_string(n) + ", one per point of the Laplacian");
    }
  };
  check("points", points.rows());
  check("frames.normals", frames.normals.rows());
  check("frames.tangents", frames.tangents.rows());
}

/// Neighbours of a point with the coefficients of their differences to it.
struct Stencil {
  std::vector<int> neighbors;
  Eigen::Matrix2Xd coefficients;
  bool is_narrow = true;
};

void addNeighbors(const SparseMatrix& L, int i, std::vector<int>& neighbors) {
  for (SparseMatrix::InnerIterator entry(L, i); entry; ++entry) neighbors.push_back(static_cast<int>(entry.row()));
}

/// @param neighbors ascending; the point itself among them does not count
Stencil fitPlane(const Points& points, const Frames& frames, int i, std::vector<int> neighbors) {
  std::erase(neighbors, i);
  const auto count = static_cast<Eigen::Index>(neighbors.size());
  double extent = 0;
  for (const int j : neighbors) extent = std::max(extent, (points.row(j) - points.row(i)).cwiseAbs().maxCoeff());
  Stencil stencil{std::move(neighbors), Eigen::Matrix2Xd::Zero(2, count)};
  if (!(extent > 0) || !std::isfinite(extent)) return stencil;

  const Eigen::RowVector3d normal = frames.normals.row(i), x = frames.tangents.row(i), y = normal.cross(x);
  Eigen::Matrix2Xd edges(2, count);  // over their extent, so that no square underflows
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::RowVector3d edge = (points.row(stencil.neighbors[k]) - points.row(i)) / extent;
    edges.col(k) << edge.dot(x), edge.dot(y);
  }
  const Eigen::Matrix2d spread = edges * edges.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(spread);
  const Eigen::Vector2d& spreads = solver.eigenvalues();  // ascending
  Eigen::Vector2d inverse = Eigen::Vector2d::Zero();
  for (int k = 0; k < 2; ++k) {
    if (spreads[k] > flat * spreads[1]) inverse[k] = 1 / spreads[k];
  }
  const Eigen::Matrix2d pseudo = solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
  stencil.coefficients = pseudo * edges / extent;
  stencil.is_narrow = !(spreads[0] > narrow * spreads[1]);
  return stencil;
}

Stencil stencilOf(const SparseMatrix& L, const Points& points, const Frames& frames, int i) {
  std::vector<int> neighbors;
  addNeighbors(L, i, neighbors);
  Stencil stencil = fitPlane(points, frames, i, neighbors);
  if (!stencil.is_narrow) return stencil;
  for (const int j : std::vector<int>(neighbors)) addNeighbors(L, j, neighbors);
  std::sort(neighbors.begin(), neighbors.end());
  neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
  return fitPlane(points, frames, i, std::move(neighbors));
}

}  // namespace

Frames meshFrames(const Points& points, const Triangles& triangles) {
  std::vector<Eigen::Matrix3d> moments(points.rows(), Eigen::Matrix3d::Zero());
  Points sums = Points::Zero(points.rows(), 3);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      if (triangles(f, k) >= 0 && triangles(f, k) < points.rows()) continue;
      throw InvalidInput("meshFrames: corner " + std::to_string(triangles(f, k)) + " of triangle " + std::to_string(f) +
                         ", must lie in [0, " + std::to_string(points.rows()) + ")");
    }
    const Eigen::RowVector3d a = points.row(triangles(f, 0));
    const Eigen::RowVector3d u = points.row(triangles(f, 1)) - a, v = points.row(triangles(f, 2)) - a;
    const double size = std::max(u.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff());
    if (!(size > 0) || !std::isfinite(size)) continue;
    // The unit normal times the area over size, as the area itself may underflow.
    const Eigen::RowVector3d normal = (u / size).cross(v / size) * size;
    const double weight = normal.norm();
    if (!(weight > 0)) continue;
    for (int k = 0; k < 3; ++k) {
      moments[triangles(f, k)] += normal.transpose() * (normal / weight);
      sums.row(triangles(f, k)) += normal;
    }
  }
  Frames frames{Points(points.rows(), 3), Points(points.rows(), 3), Orientation::given};
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
    const double scale = moments[i].trace();
    if (scale > 0) {
      normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments[i] / scale).eigenvectors().col(2);
      if (normal.dot(sums.row(i)) < 0) normal = -normal;
    }
    frames.normals.row(i) = normal;
    frames.tangents.row(i) = tangentOf(normal);
  }
  return frames;
}

Gradients gradients(const Laplacian& laplacian, const Points& points) {
  checkSizes("gradients", laplacian);
  if (laplacian.frames.normals.rows() == 0 && !laplacian.status.empty()) {
    throw InvalidInput("gradients: the Laplacian has no frames, must be that of a cloud; meshes have meshFrames()");
  }
  return gradients(laplacian, points, laplacian.frames);
}

Gradients gradients(const Laplacian& laplacian, const Points& points, const Frames& frames) {
  checkArguments(laplacian, points, frames);
  const auto n = static_cast<int>(laplacian.status.size());
  std::vector<Eigen::Triplet<double>> x, y;
  Gradients result{SparseMatrix(n, n), SparseMatrix(n, n), frames};
  for (int i = 0; i < n; ++i) {
    const int source = laplacian.representative[i];
    if (laplacian.status[source] != PointStatus::active) {
      result.frames.normals.row(i) = Eigen::RowVector3d::UnitZ();
      result.frames.tangents.row(i) = Eigen::RowVector3d::UnitX();
      continue;
    }
    result.frames.normals.row(i) = frames.normals.row(source);
    result.frames.tangents.row(i) = frames.tangents.row(source);
    const Stencil stencil = stencilOf(laplacian.L, points, frames, source);
    const Eigen::Vector2d sum = stencil.coefficients.rowwise().sum();
    x.emplace_back(i, source, -sum.x());
    y.emplace_back(i, source, -sum.y());
    for (std::size_t k = 0; k < stencil.neighbors.size(); ++k) {
      x.emplace_back(i, stencil.neighbors[k], stencil.coefficients(0, static_cast<Eigen::Index>(k)));
      y.emplace_back(i, stencil.neighbors[k], stencil.coefficients(1, static_cast<Eigen::Index>(k)));
    }
  }
  result.X.setFromTriplets(x.begin(), x.end());
  result.Y.setFromTriplets(y.begin(), y.end());
  return result;
}

}  // namespace tufted
