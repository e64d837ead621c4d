// The exact logarithmic map: in the plane, around corners, across edges of three triangles, and beside shortest paths.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::log_map_test {
namespace {

using Eigen::RowVector2d;
using Eigen::RowVector3d;

constexpr double pi = std::numbers::pi;

/// The map of a mesh, or of a cloud if there are no triangles, with the first axis along x.
Eigen::MatrixX2d mapAlongX(const Points& points, const Triangles& triangles, int source) {
  const Laplacian laplacian = triangles.rows() > 0 ? meshLaplacian(points, triangles) : pointCloudLaplacian(points);
  const Frames frames = triangles.rows() > 0 ? meshFrames(points, triangles) : laplacian.frames;
  const LogMap map = LogMapSolver(laplacian, frames).query(source, {1, 0, 0});
  EXPECT_NEAR(map.first[0], 1, 1e-12);
  Eigen::MatrixX2d result = map.coordinates;
  if (map.second[1] < 0) result.col(1) *= -1;
  return result;
}

/// A grid of points (i, j), i and j in [0, n], jittered inside, all diagonals in one direction; cells for which
/// `has` is false are left out.
struct Grid {
  Points points;
  Triangles triangles;
};
template <class Has>
Grid jitteredGrid(int n, const Has& has) {
  shapes::Random random(101);
  Grid grid;
  grid.points.resize((n + 1) * (n + 1), 3);
  const auto at = [n](int i, int j) { return i * (n + 1) + j; };
  const auto isInside = [&](int i, int j) {
    return i > 0 && j > 0 && i < n && j < n && has(i, j) && has(i - 1, j) && has(i, j - 1) && has(i - 1, j - 1);
  };
  std::vector<Eigen::RowVector3i> triangles;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double reach = isInside(i, j) ? 0.24 : 0;  // from 0.25 on triangles may be turned over
      grid.points.row(at(i, j)) << i + reach * (2 * random.uniform() - 1), j + reach * (2 * random.uniform() - 1), 0;
      if (i == n || j == n || !has(i, j)) continue;
      const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  grid.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f) grid.triangles.row(static_cast<Eigen::Index>(f)) = triangles[f];
  return grid;
}

TEST(ExactLogMap, OfAPlaneIsThePlane) {
  const Grid grid = jitteredGrid(20, [](int, int) { return true; });
  for (const int source : {0, 7, 10 * 21 + 10}) {
    const Eigen::MatrixX2d map = mapAlongX(grid.points, grid.triangles, source);
    const Points offsets = grid.points.rowwise() - grid.points.row(source).eval();
    EXPECT_LT((map - offsets.leftCols<2>()).cwiseAbs().maxCoeff(), 1e-10);
  }
  const Points cloud = shapes::square(2000, shapes::Sampling::uniform, shapes::Rim::none, 101).points;
  const Eigen::MatrixX2d map = mapAlongX(cloud, {}, 1000);
  const Points offsets = cloud.rowwise() - cloud.row(1000).eval();
  // Where the rim of a sample is not convex, paths bend.
  int straight = 0;
  for (int i = 0; i < 2000; ++i) {
    EXPECT_GT(map.row(i).norm(), offsets.row(i).norm() - 1e-10);
    straight += (map.row(i) - offsets.row(i).leftCols<2>()).norm() < 1e-10 ? 1 : 0;
  }
  EXPECT_GT(straight, 1950);
}

TEST(ExactLogMap, LeadsAroundACorner) {
  constexpr int n = 16, half = n / 2;
  const Grid grid = jitteredGrid(n, [](int i, int j) { return i < half || j < half; });
  const int source = 2 * (n + 1) + 13;  // beside the notch i, j > half
  const Eigen::MatrixX2d map = mapAlongX(grid.points, grid.triangles, source);
  const RowVector2d from = grid.points.row(source).leftCols<2>(), corner(half, half), to_corner = corner - from;
  int around = 0;
  for (int i = 0; i < grid.points.rows(); ++i) {
    const RowVector2d place = grid.points.row(i).leftCols<2>();
    if (place[0] > half && place[1] > half) continue;
    const RowVector2d beyond = place - corner;
    const bool bends = beyond[0] > 1e-9 && to_corner[0] * beyond[1] - to_corner[1] * beyond[0] > 1e-9;
    const RowVector2d expected =
        bends ? RowVector2d(to_corner.normalized() * (to_corner.norm() + beyond.norm())) : RowVector2d(place - from);
    EXPECT_LT((map.row(i) - expected).norm(), 1e-9) << place;
    around += bends ? 1 : 0;
  }
  EXPECT_GT(around, 20);
}

TEST(ExactLogMap, GoesStraightOnWhereThreeSheetsMeet) {
  // Three sheets at the line x = 0; the first one is the half-plane x < 0, the others are turned upwards.
  constexpr int n = 6;
  Points points(3 * n * (n + 1) + n + 1, 3);
  std::vector<Eigen::RowVector3i> triangles;
  const auto at = [](int sheet, int i, int j) { return i == 0 ? j : (n + 1) * (1 + sheet * n + i - 1) + j; };
  const double turns[] = {pi, 0.3, -0.8};
  for (int sheet = 0; sheet < 3; ++sheet) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        points.row(at(sheet, i, j)) << i * std::cos(turns[sheet]), j, i * std::sin(turns[sheet]);
        if (i == n || j == n) continue;
        triangles.push_back({at(sheet, i, j), at(sheet, i + 1, j), at(sheet, i + 1, j + 1)});
        triangles.push_back({at(sheet, i, j), at(sheet, i + 1, j + 1), at(sheet, i, j + 1)});
      }
    }
  }
  Triangles faces(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f) faces.row(static_cast<Eigen::Index>(f)) = triangles[f];
  const Eigen::MatrixX2d map = mapAlongX(points, faces, at(0, 3, 2));
  for (int sheet = 0; sheet < 3; ++sheet) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        const RowVector2d expected(sheet == 0 ? 3 - i : 3 + i, j - 2);
        EXPECT_LT((map.row(at(sheet, i, j)) - expected).norm(), 1e-9) << sheet << " " << i << " " << j;
      }
    }
  }
}

TEST(ExactLogMap, HasTheLengthsAndDirectionsOfShortestPaths) {
  const shapes::Mesh ball = shapes::icosphere(3);
  Points points = ball.points;
  shapes::Random random(101);
  for (int i = 0; i < points.rows(); ++i) points.row(i) *= 1 + 0.05 * random.uniform();
  const Laplacian laplacian = meshLaplacian(points, ball.triangles);
  const PathSolver paths(laplacian);
  const LogMap map = LogMapSolver(laplacian, meshFrames(points, ball.triangles)).query(50);
  int compared = 0;
  for (int i = 0; i < points.rows(); i += 7) {
    if (i == 50) continue;
    const SurfacePath path = paths.query(50, i);
    // Paths are short ones, and not always the shortest.
    EXPECT_LT(map.coordinates.row(i).norm(), path.length * (1 + 1e-9));
    EXPECT_GT(map.coordinates.row(i).norm(), path.length * (1 - 0.01));
    if (map.coordinates.row(i).norm() < path.length * (1 - 1e-9)) continue;
    ++compared;
    const RowVector3d way = path.points.row(1) - path.points.row(0);
    const double angle = std::atan2(way.dot(map.second), way.dot(map.first));
    const double found = std::atan2(map.coordinates(i, 1), map.coordinates(i, 0));
    EXPECT_LT(std::abs(std::remainder(found - angle, 2 * pi)), 0.02) << i;
  }
  EXPECT_GT(compared, 60);
}

/// The surface of a box of 2 x 1 x 1 on a grid of a fifth, and a wall across its middle.
std::pair<Points, Triangles> boxWithAWall() {
  std::map<std::array<int, 3>, int> numbers;
  std::vector<Eigen::RowVector3i> triangles;
  const auto add = [&](const Eigen::Array3i& corner, const Eigen::Array3i& a, const Eigen::Array3i& b) {
    const auto at = [&](const Eigen::Array3i& p) {
      return numbers.emplace(std::array{p[0], p[1], p[2]}, static_cast<int>(numbers.size())).first->second;
    };
    triangles.push_back({at(corner), at(corner + a), at(corner + a + b)});
    triangles.push_back({at(corner), at(corner + a + b), at(corner + b)});
  };
  const Eigen::Array3i size(10, 5, 5);
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Eigen::Array3i along_u = Eigen::Array3i::Zero(), along_v = along_u, corner = along_u;
    along_u[u] = along_v[v] = 1;
    for (const int level : axis == 0 ? std::vector<int>{0, 5, 10} : std::vector<int>{0, 5}) {
      corner[axis] = level;
      for (corner[u] = 0; corner[u] < size[u]; ++corner[u])
        for (corner[v] = 0; corner[v] < size[v]; ++corner[v]) add(corner, along_u, along_v);
    }
  }
  Points points(std::ssize(numbers), 3);
  for (const auto& [place, number] : numbers) points.row(number) << place[0] / 5.0, place[1] / 5.0, place[2] / 5.0;
  Triangles faces(std::ssize(triangles), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f) faces.row(static_cast<Eigen::Index>(f)) = triangles[f];
  return {points, faces};
}

// A box with a wall inside, which is reached through vertices alone.
TEST(ExactLogMap, IsSymmetricWhereAWallMeetsABox) {
  const auto [points, triangles] = boxWithAWall();
  const Laplacian laplacian = meshLaplacian(points, triangles);
  const LogMapSolver solver(laplacian, meshFrames(points, triangles));
  const auto n = static_cast<int>(points.rows());
  Eigen::MatrixXd distance(n, n);
  for (int i = 0; i < n; ++i) distance.col(i) = solver.query(i).coordinates.rowwise().norm();
  EXPECT_LT((distance - distance.transpose()).cwiseAbs().maxCoeff(), 1e-12);
  const PathSolver paths(laplacian);
  for (int i = 1; i < n; i += 3) EXPECT_LT(distance(i, 0), paths.query(0, i).length * (1 + 1e-9)) << i;
}

TEST(ExactLogMap, EndsOrIsRefusedInThinTriangles) {
  Points points(3, 3);
  points << 0, 0, 0, 1, 0, 0, 2, 0, 0;
  Triangles flat(1, 3);
  flat << 0, 1, 2;
  const LogMapSolver solver(meshLaplacian(points, flat), meshFrames(points, flat));
  try {
    EXPECT_NEAR(solver.query(1).coordinates.row(2).norm(), 1, 1e-6);
  } catch (const SolverFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("take the method heat"), std::string::npos);
  }
}

}  // namespace
}  // namespace tufted::log_map_test
