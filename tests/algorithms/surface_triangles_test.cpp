// Triangles of clouds whose surface is known.
#include "tufted/surface_triangles.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <vector>

#include "shapes/shapes.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::surface_triangles_test {
namespace {

using Corners = std::array<int, 3>;

/// How many triangles each edge has, counted without the code under test.
std::map<std::pair<int, int>, int> edgesOf(const Triangles& triangles) {
  std::map<std::pair<int, int>, int> edges;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      ++edges[{std::min(a, b), std::max(a, b)}];
    }
  }
  return edges;
}

/// V - E + F of a surface whose points all have triangles.
std::int64_t eulerCharacteristic(const Points& points, const Triangles& triangles) {
  return points.rows() - std::ssize(edgesOf(triangles)) + triangles.rows();
}

std::vector<Corners> sortedTriangles(const Triangles& triangles) {
  std::vector<Corners> result;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    Corners corners = {triangles(f, 0), triangles(f, 1), triangles(f, 2)};
    std::sort(corners.begin(), corners.end());
    result.push_back(corners);
  }
  std::sort(result.begin(), result.end());
  return result;
}

void expectClosed(const Points& points, std::int64_t characteristic) {
  TriangleReport report;
  const Triangles triangles = surfaceTriangles(pointCloudLaplacian(points), {}, &report);
  EXPECT_EQ(report.triangles, triangles.rows());
  EXPECT_EQ(report.open_edges, 0);
  EXPECT_EQ(report.nonmanifold_vertices, 0);
  EXPECT_EQ(report.disagreeing_edges, 0);
  EXPECT_EQ(report.components, 1);
  for (const auto& [edge, faces] : edgesOf(triangles)) EXPECT_EQ(faces, 2) << edge.first << ' ' << edge.second;
  EXPECT_EQ(eulerCharacteristic(points, triangles), characteristic);
  // Outwards: the volume is positive.
  double volume = 0;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    volume += points.row(triangles(f, 0)).dot(points.row(triangles(f, 1)).cross(points.row(triangles(f, 2))));
  EXPECT_GT(volume, 0);
}

TEST(SurfaceTriangles, OfSpheresAreClosed) {
  for (const int n : {1000, 4000, 16000}) expectClosed(shapes::sphere(n).points, 2);
}

TEST(SurfaceTriangles, OfATorusAreClosed) {
  for (const int n : {4000, 16000}) expectClosed(shapes::torus(n).points, 0);
}

TEST(SurfaceTriangles, OfALatticeHaveOneDiagonalInEachSquare) {
  Points points(400, 3);
  for (int i = 0; i < 400; ++i) points.row(i) << i / 20, i % 20, 0;
  TriangleReport report;
  const Triangles triangles = surfaceTriangles(pointCloudLaplacian(points), {}, &report);
  EXPECT_EQ(triangles.rows(), 2 * 19 * 19);
  EXPECT_EQ(report.open_edges, 4 * 19);
  EXPECT_EQ(eulerCharacteristic(points, triangles), 1);
}

TEST(SurfaceTriangles, OfNoisyPointsHaveOneOrTwoAtEachEdge) {
  const Points points = shapes::withNoise(shapes::torus(8000), 0.01).points;
  TriangleReport report;
  const Triangles triangles = surfaceTriangles(pointCloudLaplacian(points), {}, &report);
  std::int64_t inner = 0, open = 0;
  for (const auto& [edge, faces] : edgesOf(triangles)) {
    EXPECT_LE(faces, 2);
    (faces == 2 ? inner : open) += 1;
  }
  EXPECT_EQ(report.inner_edges, inner);
  EXPECT_EQ(report.open_edges, open);
  EXPECT_GE(static_cast<double>(inner), 0.999 * static_cast<double>(inner + open));
}

TEST(SurfaceTriangles, LeaveNoHoleOfThreeOrFourEdges) {
  const Points points = shapes::withNoise(shapes::sphere(8000), 0.01).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Triangles triangles = surfaceTriangles(laplacian);
  std::map<int, std::vector<int>> open;
  for (const auto& [edge, faces] : edgesOf(triangles)) {
    if (faces == 2) continue;
    open[edge.first].push_back(edge.second);
    open[edge.second].push_back(edge.first);
  }
  int holes = 0;
  for (const auto& [p, around] : open) {
    for (const int a : around) {
      for (const int b : around) {
        if (a >= b) continue;
        for (const int c : open[a]) holes += c != p && std::count(open[b].begin(), open[b].end(), c) > 0 ? 1 : 0;
      }
    }
  }
  EXPECT_LE(holes, 4);  // a component of two triangles looks like one, from each of its corners
}

TEST(SurfaceTriangles, ArePermutedWithThePoints) {
  const Points points = shapes::withNoise(shapes::torus(3000), 0.005).points;
  std::vector<int> order(3000);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(7));
  const Triangles expected = surfaceTriangles(pointCloudLaplacian(points));
  Triangles found = surfaceTriangles(pointCloudLaplacian(points(order, Eigen::all)));
  for (int& corner : found.reshaped()) corner = order[corner];
  EXPECT_EQ(sortedTriangles(found), sortedTriangles(expected));
}

TEST(SurfaceTriangles, DependOnNormalsForTheirOrientationAlone) {
  const Points points = shapes::saddle(2000).points;
  Laplacian laplacian = pointCloudLaplacian(points);
  const Triangles before = surfaceTriangles(laplacian);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (laplacian.frames.normals(i, 2) < 0) laplacian.frames.normals.row(i) *= -1;
  laplacian.frames.orientation = Orientation::given;
  const Triangles up = surfaceTriangles(laplacian);
  laplacian.frames.normals *= -1;
  const Triangles down = surfaceTriangles(laplacian);
  EXPECT_EQ(sortedTriangles(before), sortedTriangles(up));
  EXPECT_EQ(sortedTriangles(up), sortedTriangles(down));
  const auto area = [&](const Triangles& t) {
    const Eigen::RowVector3d a = points.row(t(0, 0)), b = points.row(t(0, 1)), c = points.row(t(0, 2));
    return (b - a).cross(c - a)[2];
  };
  EXPECT_GT(area(up), 0);
  EXPECT_LT(area(down), 0);
}

TEST(SurfaceTriangles, OfOddPointsAreDefined) {
  Points points = shapes::sphere(500).points;
  points.row(3).setConstant(NAN);
  points.row(9) = points.row(1);
  points.row(12) << 50, 50, 50;
  const Triangles triangles = surfaceTriangles(pointCloudLaplacian(points));
  for (const int odd : {3, 9, 12}) EXPECT_TRUE((triangles.array() != odd).all());
  for (const int n : {0, 1, 3, 4})
    EXPECT_LE(surfaceTriangles(pointCloudLaplacian(shapes::sphere(n + 1).points.topRows(n))).rows(), 4);
  EXPECT_EQ(surfaceTriangles(pointCloudLaplacian(Points::Ones(9, 3))).rows(), 0);
}

TEST(SurfaceTriangles, RefuseWhatDoesNotFit) {
  const shapes::Mesh ball = shapes::icosphere(1);
  Laplacian mesh = meshLaplacian(ball.points, ball.triangles);
  mesh.frames = meshFrames(ball.points, ball.triangles);
  EXPECT_EQ(support::refusal([&] { surfaceTriangles(mesh); }),
            "surfaceTriangles: the Laplacian is of a mesh, must be of a cloud: a mesh has triangles of its own");
  const Points points = shapes::sphere(100).points;
  EXPECT_EQ(support::refusal([&] { surfaceTriangles(pointCloudLaplacian(points, {.keep_cover = false})); }),
            "surfaceTriangles: the Laplacian has no cover, must have one: keep_cover = true");
  EXPECT_THROW(
      surfaceTriangles(pointCloudLaplacian(points), {.progress = [](std::string_view, double) { return false; }}),
      Cancelled);
}

}  // namespace
}  // namespace tufted::surface_triangles_test
