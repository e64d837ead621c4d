// The vector heat method on shapes where transport and the logarithmic map are known.
#include "tufted/vector_heat.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>

#include "shapes/shapes.h"
#include "support/odd_cloud.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::vector_heat_test {
namespace {

constexpr double pi = std::numbers::pi;

Points rows(std::initializer_list<Eigen::RowVector3d> vectors) {
  Points result(std::ssize(vectors), 3);
  Eigen::Index i = 0;
  for (const Eigen::RowVector3d& vector : vectors) result.row(i++) = vector;
  return result;
}

/// Every second normal turned round, which turns the frame's handedness.
Frames halfTurned(Frames frames) {
  for (Eigen::Index i = 0; i < frames.normals.rows(); i += 2) frames.normals.row(i) *= -1;
  return frames;
}

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The mean angle, in radians, between a vector that is transported over the unit sphere, as far as 2.5 from its
/// source, and the same turned about the axis of the great circle.
double errorOnSphere(int n) {
  const Points points = shapes::sphere(n).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const int source = 7;
  const Eigen::Vector3d start = points.row(source), vector = start.cross(Eigen::Vector3d::UnitX()).normalized();
  const Points found = TransportSolver(laplacian).query({source}, rows({vector.transpose()}));
  double sum = 0;
  int count = 0;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d end = points.row(i);
    const double angle = angleBetween(start, end);
    if (angle > 2.5) continue;
    const Eigen::Vector3d tangent = found.row(i) - found.row(i).dot(end) * end.transpose();
    const Eigen::AngleAxisd turn(angle, start.cross(end).normalized());
    sum += angleBetween(turn * vector, tangent);
    ++count;
    EXPECT_NEAR(found.row(i).norm(), 1, 0.01);
  }
  return sum / count;
}

TEST(Transport, OnASphereTurnsWithTheGreatCircle) {
  EXPECT_LE(errorOnSphere(4000), 4e-3);
  EXPECT_LE(errorOnSphere(16000), 3e-3);
  EXPECT_LE(errorOnSphere(64000), 2e-3);
}

TEST(Transport, OnAPlaneIsConstantWhicheverWayNormalsPoint) {
  const Points points = shapes::square(2000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Points given = rows({{3, 4, 0}});
  for (const Frames& frames : {laplacian.frames, halfTurned(laplacian.frames)}) {
    const Points found = TransportSolver(laplacian, frames).query({5}, given);
    EXPECT_LE((found.rowwise() - given.row(0)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Transport, DoesNotDependOnTheSignsOfNormals) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(2000).points);
  const std::vector<int> sources = {5, 900};
  const Points vectors = rows({{1, 2, 3}, {-2, 0, 1}});
  const Points found = TransportSolver(laplacian).query(sources, vectors);
  const Points turned = TransportSolver(laplacian, halfTurned(laplacian.frames)).query(sources, vectors);
  EXPECT_LE((found - turned).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Transport, TurnsWithTheShape) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Points points = shapes::torus(1500).points, vector = rows({{1, 2, 3}});
  const Points found = TransportSolver(pointCloudLaplacian(points)).query({3}, vector);
  const Points turned =
      TransportSolver(pointCloudLaplacian(points * turn.transpose())).query({3}, vector * turn.transpose());
  EXPECT_LE((found * turn.transpose() - turned).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Transport, GoesOnWhereHeatUnderflows) {
  // Heat falls to 0.6 with every edge, and 2,000 of them are more than a double can tell from 0.
  Points points(8000, 3);
  for (int i = 0; i < 8000; ++i) points.row(i) << i / 4, i % 4, 0;
  VectorHeatReport report;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Points found = TransportSolver(laplacian).query({1}, rows({{1, 1, 0}}), &report);
  EXPECT_GT(report.rounds, 1);
  EXPECT_LE((found.rowwise() - Eigen::RowVector3d(1, 1, 0)).cwiseAbs().maxCoeff(), 1e-9);
  const Eigen::MatrixXd values = ExtensionSolver(laplacian).query({0, 7999}, Eigen::Vector2d(1, 2));
  for (int i = 0; i < 8000; ++i) EXPECT_NEAR(values(i, 0), i < 4000 ? 1 : 2, std::abs(i - 4000) > 120 ? 1e-9 : 1) << i;
}

TEST(Transport, ByMultigridIsTheSame) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(5000).points);
  const Points vector = rows({{1, 2, 3}});
  VectorHeatReport report;
  const Points found = TransportSolver(laplacian).query({3}, vector);
  const TransportSolver solver(laplacian, {.solver = {.method = SolverMethod::multigrid}});
  const Points same = solver.query({3}, vector, &report);
  EXPECT_TRUE(solver.report().iterative);
  EXPECT_GT(report.iterations, 0);
  EXPECT_GT(report.rounds, 1);
  EXPECT_LE((found - same).rowwise().norm().maxCoeff(), 1e-4);
}

TEST(Extension, StaysWithinTheValuesAndIsThatOfTheNearest) {
  const Points points = shapes::sphere(4000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const std::vector<int> sources = {10, 2000, 3000};
  Eigen::MatrixXd values(3, 2);
  values << 1e9 + 1, 5, 1e9 + 2, 5, 1e9 + 4, 5;
  const Eigen::MatrixXd found = ExtensionSolver(laplacian).query(sources, values);
  EXPECT_GE(found.col(0).minCoeff(), 1e9 + 1);
  EXPECT_LE(found.col(0).maxCoeff(), 1e9 + 4);
  EXPECT_EQ(found.col(1), VectorXd::Constant(4000, 5));
  int right = 0, clear = 0;
  for (int i = 0; i < 4000; ++i) {
    Eigen::Vector3d away;
    for (int s = 0; s < 3; ++s) away[s] = angleBetween(points.row(i), points.row(sources[s]));
    int nearest = 0;
    const double least = away.minCoeff(&nearest);
    away[nearest] = 10;
    if (away.minCoeff() - least < 0.5) continue;  // next to a seam, nine spacings wide on either side
    ++clear;
    right += std::abs(found(i, 0) - values(nearest, 0)) < 0.15;  // a twentieth of the range
  }
  EXPECT_GT(clear, 2000);
  EXPECT_GE(right, clear * 0.99);
}

const LogMapOptions by_heat = {.method = LogMapMethod::heat};

/// Errors of the logarithmic map on the unit sphere at distances of 0.3 to 2.5: mean angle in radians, mean distance.
Eigen::Vector2d logMapErrors(int n) {
  const Points points = shapes::sphere(n).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const LogMapSolver solver(laplacian, halfTurned(laplacian.frames), by_heat);
  const int source = 7;
  const Eigen::RowVector3d start = points.row(source);
  const LogMap map = solver.query(source);
  EXPECT_NEAR(map.first.dot(map.second), 0, 1e-12);
  const auto tangent = [&](const Eigen::RowVector3d& v) { return Eigen::RowVector3d(v - v.dot(start) * start); };
  const Eigen::RowVector3d x = tangent(map.first), y = tangent(map.second);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (int i = 0; i < n; ++i) {
    const double distance = angleBetween(start, points.row(i));
    if (distance < 0.3 || distance > 2.5) continue;
    ++count;
    const double angle = std::atan2(points.row(i).dot(y), points.row(i).dot(x));
    const Eigen::RowVector2d found = map.coordinates.row(i);
    sum[0] += std::abs(std::remainder(std::atan2(found[1], found[0]) - angle, 2 * pi));
    sum[1] += std::abs(found.norm() - distance);
  }
  return sum / count;
}

TEST(LogMap, OnASphereHasItsAnglesAndDistances) {
  const Eigen::Vector2d coarse = logMapErrors(4000), middle = logMapErrors(16000), fine = logMapErrors(64000);
  for (const Eigen::Vector2d& errors : {coarse, middle, fine}) EXPECT_LE(errors[0], 0.02);
  EXPECT_LT(middle[1], coarse[1]);
  EXPECT_LT(fine[1], middle[1]);
}

TEST(LogMap, OfAPlaneIsThePlane) {
  const Points points = shapes::square(10000).points;
  int source = 0;
  (points.rowwise() - points.colwise().mean()).rowwise().norm().minCoeff(&source);
  const LogMap map = LogMapSolver(pointCloudLaplacian(points), by_heat).query(source, {1, 1, 0});
  EXPECT_NEAR(map.first.dot(Eigen::RowVector3d(1, 1, 0)), std::sqrt(2), 1e-9);
  double sum = 0;
  for (int i = 0; i < 10000; ++i) {
    const Eigen::RowVector3d offset = points.row(i) - points.row(source);
    const double angle = std::atan2(offset.dot(map.second), offset.dot(map.first));
    const Eigen::RowVector2d found = map.coordinates.row(i);
    if (i != source) sum += std::abs(std::remainder(std::atan2(found[1], found[0]) - angle, 2 * pi));
  }
  EXPECT_LE(sum / 10000, 1e-2);
  EXPECT_EQ(map.coordinates.row(source), Eigen::RowVector2d::Zero());
}

TEST(LogMap, OfAMesh) {
  const shapes::Mesh ball = shapes::icosphere(4);
  const Laplacian laplacian = meshLaplacian(ball.points, ball.triangles);
  const LogMap map = LogMapSolver(laplacian, meshFrames(ball.points, ball.triangles), by_heat).query(0);
  double sum = 0;
  for (Eigen::Index i = 1; i < ball.points.rows(); ++i) {
    const double angle = std::atan2(ball.points.row(i).dot(map.second), ball.points.row(i).dot(map.first));
    if (angleBetween(ball.points.row(0), ball.points.row(i)) > 2.5) continue;
    sum += std::abs(std::remainder(std::atan2(map.coordinates(i, 1), map.coordinates(i, 0)) - angle, 2 * pi));
  }
  EXPECT_LE(sum / static_cast<double>(ball.points.rows()), 0.02);
}

TEST(VectorHeat, OfOddPointsIsDefined) {
  const Laplacian laplacian = pointCloudLaplacian(support::oddCloud());
  const Points vectors = TransportSolver(laplacian).query({1, 2003}, rows({{1, 2, 3}, {1, 1, 1}}));
  const Eigen::MatrixXd values = ExtensionSolver(laplacian).query({1, 2002}, Eigen::Vector2d(1, 2));
  const Eigen::MatrixXd map = LogMapSolver(laplacian).query(2000).coordinates;
  EXPECT_EQ(LogMapSolver(laplacian, by_heat).query(2000).coordinates.array().isNaN().cast<int>().matrix(),
            map.array().isNaN().cast<int>().matrix());
  EXPECT_TRUE(vectors.allFinite());
  for (const int i : {2002, 2003, 1700}) {
    EXPECT_TRUE(vectors.row(i).isZero(0)) << i;
    EXPECT_TRUE(std::isnan(values(i, 0))) << i;
    EXPECT_TRUE(map.row(i).hasNaN()) << i;
  }
  EXPECT_TRUE(map.row(2000).isZero(0) && map.row(5).isZero(0));
  EXPECT_TRUE(values.topRows(1000).allFinite() && map.topRows(1000).allFinite());
  for (const int n : {3, 4, 6}) {
    const Laplacian few = pointCloudLaplacian(shapes::sphere(n).points);
    EXPECT_TRUE(LogMapSolver(few).query(0).coordinates.allFinite());
    EXPECT_TRUE(LogMapSolver(few, by_heat).query(0).coordinates.allFinite());
    EXPECT_TRUE(TransportSolver(few).query({0}, few.frames.tangents.topRows(1)).allFinite());
  }
}

TEST(VectorHeat, RefusesWhatDoesNotFit) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(100).points);
  const TransportSolver transport(laplacian);
  const ExtensionSolver extension(laplacian);
  const LogMapSolver map(laplacian);
  const Points vector = rows({{1, 2, 3}});
  using support::refusal;
  EXPECT_EQ(refusal([&] { transport.query({}, {}); }),
            "TransportSolver::query: sources is empty, must name at least one");
  EXPECT_EQ(refusal([&] { transport.query({100}, vector); }),
            "TransportSolver::query: source 100, must lie in [0, 100)");
  EXPECT_EQ(refusal([&] {
              transport.query({1, 2}, vector);
            }),
            "TransportSolver::query: vectors has 1 rows, must have 2, one per source");
  EXPECT_EQ(refusal([&] { transport.query({1}, vector * NAN); }),
            "TransportSolver::query: row 0 of vectors is not finite, must be");
  EXPECT_EQ(refusal([&] { transport.query({1}, laplacian.frames.normals.row(1)); }),
            "TransportSolver::query: the vector of source 1 stands on the tangent plane, must have a direction in it");
  EXPECT_EQ(refusal([&] { extension.query({1}, Eigen::MatrixXd::Constant(1, 1, INFINITY)); }),
            "ExtensionSolver::query: row 0 of values is not finite, must be");
  EXPECT_EQ(refusal([&] { map.query(1, {NAN, 0, 0}); }), "LogMapSolver::query: axis is not finite, must be");
  EXPECT_EQ(refusal([&] { map.query(-1); }), "LogMapSolver::query: source -1, must lie in [0, 100)");
  EXPECT_EQ(refusal([&] { TransportSolver(laplacian, {.time_step = 0}); }),
            "TransportSolver: time_step = 0, must be finite and above 0");
  for (const double step : {1e-300, 1e-6, 1e13, 1e300}) {
    const auto says = [&](const std::string& why) { return why.find("time_step = ") != std::string::npos; };
    const VectorHeatOptions options{.time_step = step};
    EXPECT_TRUE(says(refusal([&] { TransportSolver(laplacian, options); }))) << step;
    EXPECT_TRUE(says(refusal([&] { ExtensionSolver(laplacian, options); }))) << step;
    EXPECT_TRUE(says(refusal([&] { LogMapSolver(laplacian, {.time_step = step}); }))) << step;
    EXPECT_TRUE(says(refusal([&] { SignedDistanceSolver(laplacian, {.time_step = step}); }))) << step;
    EXPECT_TRUE(says(refusal([&] { DistanceSolver(laplacian, {.method = DistanceMethod::heat, .time_step = step}); })))
        << step;
  }
  Laplacian without = laplacian;
  without.positions = {};
  EXPECT_EQ(refusal([&] { ExtensionSolver{without}; }),
            "ExtensionSolver: Laplacian::positions has 0 rows, must have 100, one per point");
  const Laplacian bare = pointCloudLaplacian(shapes::sphere(100).points, {.keep_cover = false});
  EXPECT_EQ(refusal([&] { LogMapSolver{bare}; }),
            "LogMapSolver: the Laplacian has no cover, must have one: keep_cover = true");
  EXPECT_THROW(transport.query({1}, vector, nullptr, [](std::string_view, double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace tufted::vector_heat_test
