// Traced lines against geodesics of spheres and tori, and as the inverse of the logarithmic map.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/traced.h"
#include "tufted/tufted.h"

namespace tufted::tracing_accuracy_test {
namespace {

using Eigen::RowVector3d;
using support::lastOf;
using support::polylineLength;
using support::randomDirection;

constexpr double pi = std::numbers::pi;

/// A place and a direction on the way along a geodesic.
struct Motion {
  Eigen::Vector3d place, direction;
};

/// The start of a geodesic whose direction is given up to the error of a tangent plane.
Motion inPlane(const Motion& start, const Eigen::Vector3d& normal) {
  return {start.place, (start.direction - normal.dot(start.direction) * normal).normalized()};
}

/// The geodesic of the unit sphere.
Motion alongSphere(Motion start, double length) {
  const auto& [p, d] = inPlane(start, start.place);
  return {std::cos(length) * p + std::sin(length) * d, std::cos(length) * d - std::sin(length) * p};
}

/// The geodesic of shapes::torus(), by Runge-Kutta steps of its equation: it bends along the normal alone.
Motion alongTorus(Motion at, double length) {
  constexpr int steps = 300;
  constexpr double ring = 1, tube = 0.4;
  const Eigen::Vector3d centre = ring * Eigen::Vector3d(at.place.x(), at.place.y(), 0).normalized();
  at = inPlane(at, (at.place - centre) / tube);
  const auto bend = [&](const Motion& m) -> Eigen::Vector3d {
    const double radius = std::hypot(m.place.x(), m.place.y());
    const Eigen::Vector3d outward(m.place.x() / radius, m.place.y() / radius, 0);
    const Eigen::Vector3d normal = (m.place - ring * outward) / tube;
    const double around = Eigen::Vector3d(-outward.y(), outward.x(), 0).dot(m.direction);
    const double across = m.direction.squaredNorm() - around * around;
    return -(across / tube + around * around * normal.dot(outward) / radius) * normal;
  };
  const double h = length / steps;
  for (int i = 0; i < steps; ++i) {
    const auto moved = [&](double share, const Motion& by) -> Motion {
      return {at.place + share * h * by.place, at.direction + share * h * by.direction};
    };
    const Motion k1 = {at.direction, bend(at)};
    const Motion m2 = moved(0.5, k1), k2 = {m2.direction, bend(m2)};
    const Motion m3 = moved(0.5, k2), k3 = {m3.direction, bend(m3)};
    const Motion m4 = moved(1, k3), k4 = {m4.direction, bend(m4)};
    at.place += h / 6 * (k1.place + 2 * k2.place + 2 * k3.place + k4.place);
    at.direction += h / 6 * (k1.direction + 2 * k2.direction + 2 * k3.direction + k4.direction);
  }
  return at;
}

/// The greatest distances of the ends of lines from those of exact geodesics, in spacings, and of their directions, in
/// spacings over the least radius of curvature, by which planes of triangles are tilted.
std::pair<double, double> errorOn(const Points& points, const Triangles& triangles, const Frames& frames, double area,
                                  double radius, double length, Motion (*exact)(Motion, double)) {
  const GeodesicTracer tracer(points, triangles, frames);
  shapes::Random random(101);
  double worst = 0, turned = 0;
  for (int i = 0; i < 30; ++i) {
    const int vertex = random.below(static_cast<int>(points.rows()));
    const RowVector3d start = points.row(vertex), normal = frames.normals.row(vertex);
    const RowVector3d tangent = normal.cross(randomDirection(random)).normalized();
    const TracedLine traced = tracer.query(SurfacePoint::vertex(vertex), 7 * tangent, length);
    EXPECT_EQ(traced.reason, TraceEnd::length);
    EXPECT_NEAR(polylineLength(traced.line.points), length, 1e-10);
    const Motion end = exact({start, tangent}, length);
    worst = std::max(worst, (lastOf(traced).transpose() - end.place).norm());
    turned = std::max(turned, (traced.direction.transpose() - end.direction).norm());
  }
  const double spacing = std::sqrt(area / static_cast<double>(points.rows()));
  return {worst / spacing, turned * radius / spacing};
}

TEST(Trace, IsAGreatCircleOnASphere) {
  for (const int subdivisions : {3, 4, 5}) {
    const shapes::Mesh mesh = shapes::icosphere(subdivisions);
    const auto [end, turned] =
        errorOn(mesh.points, mesh.triangles, meshFrames(mesh.points, mesh.triangles), 4 * pi, 1, 1.5, alongSphere);
    EXPECT_LT(end, 0.5);
    EXPECT_LT(turned, 1);
  }
  for (const int n : {1000, 4000}) {
    const Laplacian cloud = pointCloudLaplacian(shapes::sphere(n, shapes::Sampling::jittered, 101).points);
    const auto [end, turned] =
        errorOn(cloud.positions, surfaceTriangles(cloud), cloud.frames, 4 * pi, 1, 1.5, alongSphere);
    EXPECT_LT(end, 0.5);
    EXPECT_LT(turned, 1);
  }
}

TEST(Trace, StaysInAPlaneOfSymmetry) {
  const shapes::Mesh mesh = shapes::icosphere(4);
  const GeodesicTracer tracer(mesh.points, mesh.triangles, meshFrames(mesh.points, mesh.triangles));
  const double spacing = std::sqrt(4 * pi / static_cast<double>(mesh.points.rows()));
  for (int axis = 0; axis < 3; ++axis) {
    int start = 0;  // a vertex in the plane
    while (std::abs(mesh.points(start, axis)) > 1e-12) ++start;
    const RowVector3d ahead = RowVector3d::Unit(axis).cross(mesh.points.row(start));
    const Points line = tracer.query(SurfacePoint::vertex(start), ahead, 6).line.points;
    EXPECT_GT(line.rows(), 50);
    EXPECT_LT(line.col(axis).cwiseAbs().maxCoeff(), 1e-6 * spacing) << axis;
  }
}

TEST(Trace, IsAGeodesicOnATorus) {
  const shapes::Cloud torus = shapes::torus(4000, shapes::Sampling::jittered, 101);
  const Laplacian cloud = pointCloudLaplacian(torus.points);
  const auto [end, turned] =
      errorOn(cloud.positions, surfaceTriangles(cloud), cloud.frames, torus.area, 0.4, 0.6, alongTorus);
  EXPECT_LT(end, 0.5);
  EXPECT_LT(turned, 1);
}

/// The share of points that a line traced by their logarithmic map misses by half a spacing or more.
double missed(const Laplacian& laplacian, const Triangles& triangles, const Frames& frames, double area) {
  const LogMapSolver log(laplacian, frames);
  const GeodesicTracer tracer(laplacian.positions, triangles, frames);
  const auto n = laplacian.positions.rows();
  int count = 0, far = 0;
  for (const int source : {3, 77, 500}) {
    const LogMap map = log.query(source);
    for (int i = 0; i < n; i += 7) {
      const double distance = map.coordinates.row(i).norm();
      if (!(distance > 0)) continue;
      const RowVector3d direction = map.coordinates(i, 0) * map.first + map.coordinates(i, 1) * map.second;
      const TracedLine traced = tracer.query(SurfacePoint::vertex(source), direction, distance);
      const double error = (lastOf(traced) - laplacian.positions.row(i)).norm();
      far += error < 0.5 * std::sqrt(area / static_cast<double>(n)) ? 0 : 1;
      ++count;
    }
  }
  EXPECT_GT(count, n / 7);
  return static_cast<double>(far) / count;
}

// Behind saddles lie strips that no straight line reaches. On the inner side of the torus they get narrower, in
// spacings, with the spacing.
TEST(Trace, InvertsTheLogarithmicMap) {
  const auto missedOn = [](const shapes::Cloud& cloud) {
    const Laplacian laplacian = pointCloudLaplacian(cloud.points);
    return missed(laplacian, surfaceTriangles(laplacian), laplacian.frames, cloud.area);
  };
  EXPECT_EQ(missedOn(shapes::sphere(4000, shapes::Sampling::jittered, 101)), 0);
  EXPECT_LT(missedOn(shapes::torus(4000, shapes::Sampling::jittered, 101)), 0.04);
  EXPECT_LT(missedOn(shapes::torus(16000, shapes::Sampling::jittered, 101)), 0.01);
  const shapes::Mesh ball = shapes::icosphere(4);
  EXPECT_EQ(missed(meshLaplacian(ball.points, ball.triangles), ball.triangles, meshFrames(ball.points, ball.triangles),
                   4 * pi),
            0);
}

}  // namespace
}  // namespace tufted::tracing_accuracy_test
