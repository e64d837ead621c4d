// Traced lines: straight on unrolled surfaces, the way back, ends, equivariance, and odd triangles.
#include "tufted/tracing.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "oracles/planar.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/refusal.h"
#include "support/traced.h"
#include "tufted/tufted.h"

namespace tufted::tracing_test {
namespace {

using Eigen::RowVector3d;
using support::lastOf;
using support::polylineLength;
using support::randomDirection;

constexpr double pi = std::numbers::pi;

GeodesicTracer tracerOf(const Points& points, const Triangles& triangles) {
  return {points, triangles, meshFrames(points, triangles)};
}

SurfacePoint randomPlace(const Points& points, const Triangles& triangles, shapes::Random& random) {
  const int face = random.below(static_cast<int>(triangles.rows()));
  return SurfacePoint::inFace(points, triangles, face, {random.uniform(), random.uniform(), random.uniform()});
}

/// A band of quadrilaterals, each cut in two, around n generators from `bottom` to `top`; the last joins the first.
shapes::Mesh ruled(int n, const std::function<RowVector3d(double angle, double height)>& place) {
  constexpr int rings = 4;
  shapes::Mesh mesh;
  mesh.points.resize(n * rings, 3);
  mesh.triangles.resize(2 * n * (rings - 1), 3);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < rings; ++j) mesh.points.row(i * rings + j) = place(2 * pi * i / n, j / (rings - 1.0));
  for (int i = 0, f = 0; i < n; ++i) {
    for (int j = 0; j + 1 < rings; ++j) {
      const int a = i * rings + j, b = (i + 1) % n * rings + j;
      mesh.triangles.row(f++) << a, b, b + 1;
      mesh.triangles.row(f++) << a, b + 1, a + 1;
    }
  }
  return mesh;
}

TEST(Trace, IsStraightInThePlaneAndEndsAtItsRim) {
  const oracles::PlanarMesh mesh = oracles::obtuseSquare(200, 10, 101);  // slivers
  const GeodesicTracer tracer = tracerOf(mesh.points, mesh.triangles);
  shapes::Random random(101);
  for (int i = 0; i < 200; ++i) {
    const bool is_vertex = i % 2 == 0;
    const SurfacePoint start =
        is_vertex ? SurfacePoint::vertex(random.below(204)) : randomPlace(mesh.points, mesh.triangles, random);
    RowVector3d from = RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) from += start.weights[k] * mesh.points.row(start.corners[k]);
    RowVector3d direction = randomDirection(random);
    const RowVector3d flat = RowVector3d(direction.x(), direction.y(), 0).normalized();
    const TracedLine traced = tracer.query(start, direction, 0.3);
    const RowVector3d to = from + traced.line.length * flat;
    EXPECT_LT((lastOf(traced) - to).norm(), 1e-8);  // it passes vertices within 1e-9 of the size of a triangle
    EXPECT_LT((traced.direction - flat).norm(), 1e-6);
    EXPECT_NEAR(polylineLength(traced.line.points), traced.line.length, 1e-8);
    const double until_rim = std::min((flat.x() > 0 ? 1 - from.x() : -from.x()) / flat.x(),
                                      (flat.y() > 0 ? 1 - from.y() : -from.y()) / flat.y());
    EXPECT_NEAR(traced.line.length, std::min(0.3, std::max(until_rim, 0.0)), 1e-7);
    EXPECT_EQ(traced.reason, until_rim > 0.3 ? TraceEnd::length : TraceEnd::rim);
  }
}

/// On a prism the angle is replaced by the length along the polygon, and the line is straight.
TEST(Trace, IsAHelixOnACylinder) {
  constexpr int sides = 12;
  const double side = 2 * std::sin(pi / sides);
  const shapes::Mesh mesh = ruled(
      sides, [](double angle, double height) { return RowVector3d(std::cos(angle), std::sin(angle), 3 * height); });
  const double slope = 0.11;  // height over length
  const TracedLine traced =
      tracerOf(mesh.points, mesh.triangles)
          .query(SurfacePoint::inFace(mesh.points, mesh.triangles, 0, {1, 1, 1}),
                 RowVector3d(mesh.points.row(4) - mesh.points.row(0)).normalized() + slope * RowVector3d::UnitZ(), 15);
  EXPECT_EQ(traced.reason, TraceEnd::length);
  const auto along = [&](const RowVector3d& point) {  // length around the polygon
    const double turn = std::atan2(point.y(), point.x()) / (2 * pi) * sides;
    const double whole = std::floor(turn + 1e-9);
    const double middle = 2 * pi * (whole + 0.5) / sides;
    return whole * side + side / 2 + RowVector3d(-std::sin(middle), std::cos(middle), 0).dot(point);
  };
  double laps = 0, before = along(traced.line.points.row(0));
  const double start = before, bottom = traced.line.points(0, 2);
  for (Eigen::Index i = 1; i < traced.line.points.rows(); ++i) {
    const double now = along(traced.line.points.row(i));
    if (now < before - side) laps += sides * side;
    before = now;
    EXPECT_NEAR(traced.line.points(i, 2) - bottom, slope * (now + laps - start), 1e-9);
  }
  EXPECT_NEAR(before + laps - start, 15 / std::hypot(1, slope), 1e-9);
}

/// An unrolled pyramid is a sector of the plane around its apex: a line keeps its distance from the apex.
TEST(Trace, IsStraightOnAnUnrolledCone) {
  const shapes::Mesh mesh = ruled(40, [](double angle, double height) {
    const double radius = 3 - 2.9 * height;
    return RowVector3d(radius * std::cos(angle), radius * std::sin(angle), -radius);
  });
  const GeodesicTracer tracer = tracerOf(mesh.points, mesh.triangles);
  shapes::Random random(102);
  int passed = 0;
  for (int i = 0; i < 50; ++i) {
    const SurfacePoint start = randomPlace(mesh.points, mesh.triangles, random);
    const TracedLine traced = tracer.query(start, randomDirection(random), 2);
    const Points& points = traced.line.points;
    if (points.rows() < 3) continue;
    ++passed;
    const auto distanceFromApex = [&](Eigen::Index a, Eigen::Index b) {  // of the line through two places
      return RowVector3d(points.row(a)).cross(RowVector3d(points.row(b) - points.row(a))).norm() /
             (points.row(b) - points.row(a)).norm();
    };
    for (Eigen::Index k = 1; k + 1 < points.rows(); ++k) {
      if (!((points.row(k + 1) - points.row(k)).norm() > 1e-3)) continue;
      EXPECT_NEAR(distanceFromApex(k, k + 1), distanceFromApex(0, 1), 1e-7);
    }
  }
  EXPECT_GT(passed, 30);
}

TEST(Trace, LeadsBack) {
  const std::vector<shapes::Mesh> meshes = {shapes::icosphere(2), shapes::cubeMesh(6, shapes::Quality::bad),
                                            shapes::kleinBottle(12), shapes::moebius(6)};
  for (const shapes::Mesh& mesh : meshes) {
    const GeodesicTracer tracer = tracerOf(mesh.points, mesh.triangles);
    shapes::Random random(103);
    for (int i = 0; i < 50; ++i) {
      const SurfacePoint start = randomPlace(mesh.points, mesh.triangles, random);
      const TracedLine there = tracer.query(start, randomDirection(random), 3);
      const TracedLine back = tracer.query(there.end, -there.direction, there.line.length);
      EXPECT_LT((lastOf(back) - there.line.points.row(0)).norm(), 1e-7) << mesh.name;
      EXPECT_NEAR(polylineLength(there.line.points), there.line.length, 1e-9) << mesh.name;
    }
  }
}

TEST(Trace, LeavesAVertexWithEqualAngles) {
  // Three squares meet at the corner (1, 1, 1) of a cube. Their diagonal meets it, and goes on along the opposite edge.
  const shapes::Mesh cube = shapes::cubeMesh(4, shapes::Quality::good);
  const GeodesicTracer tracer = tracerOf(cube.points, cube.triangles);
  const auto at = [&](const RowVector3d& place) {
    Eigen::Index nearest = 0;
    (cube.points.rowwise() - place).rowwise().norm().minCoeff(&nearest);
    EXPECT_LT((cube.points.row(nearest) - place).norm(), 1e-12);
    return static_cast<int>(nearest);
  };
  const int corner = at({1, 1, 1});
  RowVector3d inside(0.75, 0.75, 1);
  Eigen::Index start = 0;
  (cube.points.rowwise() - inside).rowwise().norm().minCoeff(&start);
  const RowVector3d from = cube.points.row(start), to = cube.points.row(corner) - from;
  const TracedLine traced = tracer.query(SurfacePoint::vertex(static_cast<int>(start)), to, to.norm() + 0.5);
  const double angle = std::atan2(to.y(), to.x()) - pi / 4;  // from the diagonal
  const RowVector3d expected = angle > 0 ? RowVector3d(-std::sin(angle), 0, 0) : RowVector3d(0, std::sin(angle), 0);
  EXPECT_LT((lastOf(traced) - (RowVector3d(1, 1, 1 - 0.5 * std::cos(angle)) + 0.5 * expected)).norm(), 1e-9);
  // Along edges of a flat face, from vertex to vertex.
  const TracedLine edge = tracer.query(SurfacePoint::vertex(at({0, 0, 1})), {1, 0, 0}, 0.9);
  EXPECT_LT((lastOf(edge) - RowVector3d(0.9, 0, 1)).norm(), 1e-9);
}

TEST(Trace, EndsAtRimsAndBranches) {
  const shapes::Mesh book = shapes::book(3, 4);
  const GeodesicTracer pages = tracerOf(book.points, book.triangles);
  const SurfacePoint start = SurfacePoint::inFace(book.points, book.triangles, 0, {1, 1, 1});
  const RowVector3d place = book.points(book.triangles.row(0), Eigen::all).colwise().mean();
  const RowVector3d outward(place.x(), place.y(), 0);
  const TracedLine to_spine = pages.query(start, -outward, 5), to_rim = pages.query(start, outward, 5);
  EXPECT_EQ(to_spine.reason, TraceEnd::branch);
  EXPECT_EQ(to_rim.reason, TraceEnd::rim);
  EXPECT_NEAR(to_spine.line.length, outward.norm(), 1e-12);
  EXPECT_NEAR(to_rim.line.length, 1 - outward.norm(), 1e-12);

  const shapes::Mesh grid = shapes::gridSquare(4);
  const GeodesicTracer square = tracerOf(grid.points, grid.triangles);
  const TracedLine away = square.query(SurfacePoint::vertex(0), {-1, -1, 0}, 1);
  EXPECT_EQ(away.reason, TraceEnd::rim);
  EXPECT_EQ(away.line.points, Points(grid.points.row(0)));
  EXPECT_EQ(away.line.length, 0);
  // From rim to rim through vertices.
  const TracedLine diagonal = square.query(SurfacePoint::vertex(0), {1, 1, 0}, 1e300);
  EXPECT_NEAR(diagonal.line.length, std::sqrt(2), 1e-12);
  const shapes::Mesh closed = shapes::tetrahedron();
  const TracedLine endless =
      tracerOf(closed.points, closed.triangles)
          .query(SurfacePoint::inFace(closed.points, closed.triangles, 0, {1, 2, 4}), {1, 2, 4}, 1e300);
  EXPECT_EQ(endless.reason, TraceEnd::crossings);
  EXPECT_NEAR(endless.line.length, polylineLength(endless.line.points), 1e-6 * endless.line.length);
  const TracedLine nothing = square.query(SurfacePoint::vertex(6), {1, 1, 0}, 0);
  EXPECT_EQ(nothing.line.points, Points(grid.points.row(6)));
  EXPECT_EQ(nothing.reason, TraceEnd::length);
}

TEST(Trace, MovesTurnsAndScalesWithThePoints) {
  const shapes::Mesh mesh = shapes::icosphere(3);
  const Frames frames = meshFrames(mesh.points, mesh.triangles);
  const int start = 5;
  const RowVector3d direction(1, 2, 0);
  const TracedLine traced =
      GeodesicTracer(mesh.points, mesh.triangles, frames).query(SurfacePoint::vertex(start), direction, 2);
  const auto expectPlaces = [&](const TracedLine& other, const Points& places) {
    ASSERT_EQ(other.line.points.rows(), places.rows());
    EXPECT_LT((other.line.points - places).rowwise().norm().maxCoeff(), 1e-12 * places.cwiseAbs().maxCoeff());
  };
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto turned = [&](const Points& rows) { return Points(rows * turn.transpose()); };
  const Frames turned_frames = {turned(frames.normals), turned(frames.tangents), frames.orientation};
  expectPlaces(GeodesicTracer(turned(mesh.points), mesh.triangles, turned_frames)
                   .query(SurfacePoint::vertex(start), direction * turn.transpose(), 2),
               turned(traced.line.points));
  for (const double scale : {0x1p-700, 0x1p400}) {
    const TracedLine scaled =
        tracerOf(scale * mesh.points, mesh.triangles).query(SurfacePoint::vertex(start), direction, 2 * scale);
    ASSERT_EQ(scaled.line.points.rows(), traced.line.points.rows());
    EXPECT_EQ(scaled.line.points, Points(scale * traced.line.points));
    EXPECT_EQ(scaled.line.length, 2 * scale);
    // Lengths of directions do not matter.
    const TracedLine same =
        GeodesicTracer(mesh.points, mesh.triangles, frames).query(SurfacePoint::vertex(start), scale * direction, 2);
    EXPECT_LT((lastOf(same) - lastOf(traced)).norm(), 1e-12);
  }
  const auto n = static_cast<int>(mesh.points.rows());
  const std::vector<int> order = shapes::Random(1).permutation(n);
  std::vector<int> number(order.size());
  for (int i = 0; i < n; ++i) number[order[i]] = i;
  Triangles renamed = mesh.triangles;
  for (int& corner : renamed.reshaped()) corner = number[corner];
  const Points points = mesh.points(order, Eigen::all);
  const Frames sorted = {frames.normals(order, Eigen::all), frames.tangents(order, Eigen::all), frames.orientation};
  expectPlaces(GeodesicTracer(points, renamed, sorted).query(SurfacePoint::vertex(number[start]), direction, 2),
               traced.line.points);
  // The front of triangles does not matter.
  expectPlaces(GeodesicTracer(mesh.points, mesh.triangles.rowwise().reverse(), frames)
                   .query(SurfacePoint::vertex(start), direction, 2),
               traced.line.points);
}

TEST(Trace, TakesOddTriangles) {
  for (const shapes::Mesh& mesh : shapes::allMeshes()) {
    Points points = mesh.points;
    points.conservativeResize(points.rows() + 1, 3);
    points.row(points.rows() - 1).setConstant(NAN);
    Triangles triangles = mesh.triangles;
    triangles.conservativeResize(triangles.rows() + 1, 3);
    triangles.row(triangles.rows() - 1) << 0, 1, static_cast<int>(points.rows()) - 1;
    const GeodesicTracer tracer = tracerOf(points, triangles);
    shapes::Random random(104);
    for (int i = 0; i < 40; ++i) {
      const int vertex = mesh.triangles(random.below(static_cast<int>(mesh.triangles.rows())), i % 3);
      if (support::refusal([&] { tracer.query(SurfacePoint::vertex(vertex), {1, 0, 0}, 0); }) != "accepted") continue;
      const TracedLine traced = tracer.query(SurfacePoint::vertex(vertex), randomDirection(random), 1);
      EXPECT_TRUE(traced.line.points.allFinite()) << mesh.name;
      EXPECT_NEAR(polylineLength(traced.line.points), traced.line.length, 1e-6) << mesh.name;
      EXPECT_LE(traced.line.length, 1) << mesh.name;
    }
  }
  EXPECT_NO_THROW(tracerOf(Points(0, 3), Triangles(0, 3)));
}

TEST(Trace, RefusesWhatDoesNotFit) {
  const shapes::Mesh grid = shapes::gridSquare(2);
  Points points = grid.points;
  points.conservativeResize(10, 3);
  points.row(9).setZero();
  const GeodesicTracer tracer = tracerOf(points, grid.triangles);
  const std::string name = "GeodesicTracer::query: ";
  const auto refusal = [&](const SurfacePoint& start, const RowVector3d& direction, double length) {
    return support::refusal([&] { tracer.query(start, direction, length); });
  };
  const SurfacePoint zero = SurfacePoint::vertex(0);
  EXPECT_EQ(refusal(SurfacePoint::vertex(10), {1, 0, 0}, 1), name + "start = 10, must lie in [0, 10)");
  EXPECT_EQ(refusal(SurfacePoint::vertex(9), {1, 0, 0}, 1), name + "start = 9 is in no triangle, must be in one");
  EXPECT_EQ(refusal({{0, 1, 8}, {0.5, 0.25, 0.25}, {}, {}}, {1, 0, 0}, 1),
            name + "start lies in the triangle 0 1 8, must lie in a triangle of the surface");
  EXPECT_EQ(refusal(zero, {0, 0, 0}, 1), name + "direction is not finite or 0, must be a direction");
  EXPECT_EQ(refusal(zero, {NAN, 0, 0}, 1), name + "direction is not finite or 0, must be a direction");
  EXPECT_EQ(refusal(zero, {0, 0, 1}, 1), name + "direction stands on the tangent plane, must have a direction in it");
  EXPECT_EQ(refusal(zero, {1, 0, 0}, -1), name + "length = -1.000000, must be >= 0 and finite");
  EXPECT_EQ(support::refusal([&] { GeodesicTracer(points, grid.triangles, Frames()); }),
            "GeodesicTracer: frames.normals has 0 rows, must have 10");
  EXPECT_THROW(tracer.query(zero, {1, 1, 0}, 1, [](auto, auto) { return false; }), Cancelled);
}

}  // namespace
}  // namespace tufted::tracing_test
