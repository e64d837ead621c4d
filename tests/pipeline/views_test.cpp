// Points and triangles in memory that somebody else holds: PointsRef and TrianglesRef.
#include <gtest/gtest.h>

#include <type_traits>
#include <vector>

#include "shapes/shapes.h"
#include "support/compare.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::views_test {
namespace {

using PointsMap = Eigen::Map<const Points>;
using TrianglesMap = Eigen::Map<const Triangles>;

static_assert(!std::is_convertible_v<Eigen::MatrixX3f, PointsRef>, "floats would be taken for doubles");
static_assert(!std::is_convertible_v<Triangles, PointsRef>);
static_assert(!std::is_convertible_v<Points, TrianglesRef>);
static_assert(!std::is_convertible_v<Eigen::Matrix<std::int64_t, Eigen::Dynamic, 3>, TrianglesRef>);

/// A mesh in plain vectors, each behind an entry that is not its own, so that it is not aligned as Eigen's memory is.
struct Held {
  explicit Held(const shapes::Mesh& mesh)
      : coordinates(1, NAN), corners(1, -1), vertices(mesh.points.rows()), faces(mesh.triangles.rows()) {
    coordinates.insert(coordinates.end(), mesh.points.data(), mesh.points.data() + mesh.points.size());
    corners.insert(corners.end(), mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size());
  }
  PointsMap points() const { return {coordinates.data() + 1, vertices, 3}; }
  TrianglesMap triangles() const { return {corners.data() + 1, faces, 3}; }

  std::vector<double> coordinates;
  std::vector<int> corners;
  Eigen::Index vertices, faces;
};

const void* addressOf(const PointsRef& points) {
  return points.data();
}
const void* addressOf(const TrianglesRef& triangles) {
  return triangles.data();
}

TEST(PointsRef, OfRowsInARowIsNoCopy) {
  const shapes::Mesh ball = shapes::icosphere(2);
  const Held held(ball);
  EXPECT_EQ(addressOf(ball.points), ball.points.data());
  EXPECT_EQ(addressOf(held.points()), held.coordinates.data() + 1);
  EXPECT_EQ(addressOf(ball.points.middleRows(5, 9)), ball.points.row(5).data());
  EXPECT_EQ(addressOf(held.points().bottomRows(3)), held.points().row(held.vertices - 3).data());
}

TEST(TrianglesRef, OfRowsInARowIsNoCopy) {
  const shapes::Mesh ball = shapes::icosphere(2);
  const Held held(ball);
  EXPECT_EQ(addressOf(ball.triangles), ball.triangles.data());
  EXPECT_EQ(addressOf(held.triangles()), held.corners.data() + 1);
  EXPECT_EQ(addressOf(ball.triangles.middleRows(5, 9)), ball.triangles.row(5).data());
}

TEST(PointsRef, OfAnyOtherExpressionHasItsValues) {
  const Points points = shapes::sphere(300).points;
  const Eigen::MatrixX3d by_columns = points;
  const Eigen::Map<const Points, 0, Eigen::OuterStride<>> every_second(points.data(), 150, 3, Eigen::OuterStride<>(6));
  const auto valuesOf = [](const PointsRef& view) { return Points(view); };
  EXPECT_EQ(valuesOf(by_columns), points);
  EXPECT_EQ(valuesOf(2 * points), Points(2 * points));
  EXPECT_EQ(valuesOf(every_second), Points(points(Eigen::seqN(0, 150, 2), Eigen::all)));
}

TEST(PointsRef, GivesTheSameBitsForClouds) {
  const shapes::Mesh ball = shapes::icosphere(4);
  const Held held(ball);
  const Laplacian own = pointCloudLaplacian(ball.points), mapped = pointCloudLaplacian(held.points());
  EXPECT_TRUE(support::sameBits(own.L, mapped.L));
  EXPECT_TRUE(support::sameBits(own.M, mapped.M));
  EXPECT_EQ(own.positions, mapped.positions);
  LaplacianBuilder builder;
  EXPECT_TRUE(support::sameBits(builder.pointCloud(held.points()).L, own.L));
  const Gradients slopes = gradients(own, ball.points), of_map = gradients(own, held.points());
  EXPECT_TRUE(support::sameBits(slopes.X, of_map.X));
  EXPECT_TRUE(support::sameBits(slopes.Y, of_map.Y));
  EXPECT_EQ(smooth(own, held.points()), smooth(own, ball.points));
  EXPECT_EQ(nearestPoint(own, held.points(), {0, 0, 2}), nearestPoint(own, ball.points, {0, 0, 2}));
  const Points above = 2 * ball.points.topRows(40);
  EXPECT_EQ(nearestPoints(own, held.points(), above), nearestPoints(own, ball.points, above));
}

TEST(PointsRef, GivesTheSameBitsForMeshes) {
  for (const shapes::Mesh& mesh :
       {shapes::icosphere(3), shapes::severalComponents(), shapes::unreferencedVertices(5)}) {
    const Held held(mesh);
    const Laplacian own = meshLaplacian(mesh.points, mesh.triangles),
                    mapped = meshLaplacian(held.points(), held.triangles());
    EXPECT_TRUE(support::sameBits(own.L, mapped.L));
    EXPECT_TRUE(support::sameBits(own.M, mapped.M));
    const Frames frames = meshFrames(mesh.points, mesh.triangles), of_map = meshFrames(held.points(), held.triangles());
    EXPECT_TRUE(support::sameBits(frames.normals.data(), of_map.normals.data(), frames.normals.size()));
    EXPECT_TRUE(support::sameBits(frames.tangents.data(), of_map.tangents.data(), frames.tangents.size()));
  }
}

TEST(PointsRef, OfNoMemoryIsAnEmptyCloud) {
  EXPECT_EQ(pointCloudLaplacian(PointsMap(nullptr, 0, 3)).L.rows(), 0);
  EXPECT_EQ(meshLaplacian(PointsMap(nullptr, 0, 3), TrianglesMap(nullptr, 0, 3)).L.rows(), 0);
}

TEST(PointsRef, OfTooFewRowsIsRefused) {
  const shapes::Mesh ball = shapes::icosphere(3);
  const Held held(ball);
  const Laplacian laplacian = pointCloudLaplacian(ball.points);
  const PointsMap few(held.coordinates.data() + 1, 10, 3);
  using support::refusal;
  EXPECT_EQ(refusal([&] { smooth(laplacian, few); }),
            "smooth: points has 10 rows, must have 642, one per point of the Laplacian");
  EXPECT_EQ(refusal([&] {
              nearestPoint(laplacian, few, {0, 0, 0});
            }),
            "nearestPoint: points has 10 rows, must have 642, one per point of the Laplacian");
  EXPECT_EQ(refusal([&] { gradients(laplacian, few); }).find("gradients: "), 0);
  EXPECT_NE(refusal([&] { meshLaplacian(few, held.triangles()); }), "accepted");  // triangles name other vertices
  EXPECT_NE(refusal([&] { meshFrames(few, held.triangles()); }), "accepted");
}

}  // namespace
}  // namespace tufted::views_test
