// Signed distances from curves: circles, lines and arcs, odd data, and what callers get wrong.
#include "tufted/signed_distance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "shapes/shapes.h"
#include "support/defined_values.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::signed_distance_test {
namespace {

using support::refusal;

/// Points with a curve among them, the last ones.
struct Case {
  Points points;
  std::vector<int> curve;  ///< closed
};

/// Adds a circle about the z axis, counterclockwise seen from above, with steps of about `spacing`. Points that are
/// nearer to it than half of that go.
Case withCircle(const Points& points, double radius, double height, double spacing) {
  const int around = static_cast<int>(std::ceil(2 * M_PI * radius / spacing));
  Case made;
  std::vector<int> kept;
  for (int i = 0; i < points.rows(); ++i) {
    const double away = std::hypot(points.row(i).head<2>().norm() - radius, points(i, 2) - height);
    if (away > spacing / 2) kept.push_back(i);
  }
  const int n = static_cast<int>(kept.size());
  made.points.resize(n + around, 3);
  made.points.topRows(n) = points(kept, Eigen::all);
  for (int k = 0; k < around; ++k) {
    const double angle = 2 * M_PI * k / around;
    made.points.row(n + k) << radius * std::cos(angle), radius * std::sin(angle), height;
    made.curve.push_back(n + k);
  }
  made.curve.push_back(n);
  return made;
}

/// On a disk of radius 1, the curve of radius 0.5.
Case onDisk(int n, std::uint64_t seed = 1) {
  return withCircle(shapes::disk(n, shapes::Sampling::uniform, shapes::Rim::none, seed).points, 0.5, 0,
                    std::sqrt(M_PI / n));
}
/// On the unit sphere, 60 degrees from the north pole.
Case onSphere(int n, std::uint64_t seed = 1) {
  return withCircle(shapes::sphere(n, shapes::Sampling::uniform, seed).points, std::sin(M_PI / 3), 0.5,
                    std::sqrt(4 * M_PI / n));
}

double exactOnDisk(const Eigen::RowVector3d& p) {
  return 0.5 - p.norm();
}
double exactOnSphere(const Eigen::RowVector3d& p) {
  return M_PI / 3 - std::acos(std::clamp(p.z(), -1.0, 1.0));
}

Laplacian orientedCloud(const Points& points) {
  Laplacian laplacian = pointCloudLaplacian(points);
  laplacian.frames = orientedFrames(laplacian);
  return laplacian;
}

/// Mean error over points farther than two spacings from the curve, and the share of them with a wrong sign.
template <class Exact>
std::pair<double, double> errors(const Case& given, const VectorXd& distance, double spacing, const Exact& exact) {
  double sum = 0;
  int count = 0, wrong = 0;
  for (Eigen::Index i = 0; i < distance.size(); ++i) {
    const double truth = exact(given.points.row(i));
    if (std::abs(truth) < 2 * spacing) continue;
    sum += std::abs(distance[i] - truth);
    wrong += (distance[i] > 0) != (truth > 0) ? 1 : 0;
    ++count;
  }
  return {sum / count, static_cast<double>(wrong) / count};
}

TEST(SignedDistance, FromCirclesIsOfFirstOrder) {
  double last_disk = 1, last_sphere = 1;
  for (const int n : {1000, 4000, 16000}) {
    const Case disk = onDisk(n), sphere = onSphere(n);
    const auto [disk_error, disk_wrong] = errors(
        disk, SignedDistanceSolver(orientedCloud(disk.points)).query(disk.curve), std::sqrt(M_PI / n), exactOnDisk);
    const auto [sphere_error, sphere_wrong] =
        errors(sphere, SignedDistanceSolver(orientedCloud(sphere.points)).query(sphere.curve), std::sqrt(4 * M_PI / n),
               exactOnSphere);
    EXPECT_LE(disk_wrong, 1e-3) << n;
    EXPECT_LE(sphere_wrong, 1e-3) << n;
    EXPECT_LE(disk_error, last_disk / 1.7) << n;
    EXPECT_LE(sphere_error, last_sphere / 1.7) << n;
    last_disk = disk_error, last_sphere = sphere_error;
  }
}

TEST(SignedDistance, ChangesItsSignWithTheCurveAndWithTheNormals) {
  const Case disk = onDisk(1000);
  const Laplacian laplacian = orientedCloud(disk.points);
  const VectorXd distance = SignedDistanceSolver(laplacian).query(disk.curve);
  std::vector<int> back(disk.curve.rbegin(), disk.curve.rend());
  EXPECT_LE((SignedDistanceSolver(laplacian).query(back) + distance).cwiseAbs().maxCoeff(), 1e-9);
  Frames turned = laplacian.frames;
  turned.normals *= -1;
  EXPECT_LE((SignedDistanceSolver(laplacian, turned).query(disk.curve) + distance).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(SignedDistance, OfALineAcrossASquareIsTheCoordinate) {
  const shapes::Mesh mesh = shapes::gridSquare(20);
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  std::vector<int> curve;
  for (int i = 0; i < mesh.points.rows(); ++i)
    if (std::abs(mesh.points(i, 1) - 0.5) < 1e-9) curve.push_back(i);
  std::sort(curve.begin(), curve.end(), [&](int a, int b) { return mesh.points(a, 0) < mesh.points(b, 0); });
  const VectorXd distance = SignedDistanceSolver(laplacian, meshFrames(mesh.points, mesh.triangles)).query(curve);
  for (int i = 0; i < distance.size(); ++i) EXPECT_NEAR(distance[i], mesh.points(i, 1) - 0.5, 1e-6) << i;
}

TEST(SignedDistance, GoesOnAcrossGaps) {
  const Case disk = onDisk(4000);
  std::vector<int> broken;
  for (std::size_t k = 0; k + 12 < disk.curve.size(); ++k) broken.push_back(disk.curve[k]);
  const auto [error, wrong] =
      errors(disk, SignedDistanceSolver(orientedCloud(disk.points)).query(broken), std::sqrt(M_PI / 4000), exactOnDisk);
  EXPECT_LE(error, 0.02);
  EXPECT_LE(wrong, 0.005);
}

TEST(SignedDistance, DoesNotDependOnUnitPlaceOrThreads) {
  const Case sphere = onSphere(600);
  const VectorXd distance = SignedDistanceSolver(orientedCloud(sphere.points)).query(sphere.curve);
  for (const int exponent : {400, -400}) {
    const double unit = std::ldexp(1, exponent);
    const VectorXd scaled = SignedDistanceSolver(orientedCloud(unit * sphere.points)).query(sphere.curve) / unit;
    EXPECT_LE((scaled - distance).cwiseAbs().maxCoeff(), 1e-12) << exponent;
  }
  const Points far = sphere.points.rowwise() + Eigen::RowVector3d(1e5, -1e5, 3e5);
  EXPECT_LE((SignedDistanceSolver(orientedCloud(far)).query(sphere.curve) - distance).cwiseAbs().maxCoeff(), 1e-4);
  for (const int threads : {1, 3})
    EXPECT_EQ(SignedDistanceSolver(orientedCloud(sphere.points), {.solver = {.threads = threads}}).query(sphere.curve),
              distance);
}

TEST(SignedDistance, OfOddCloudsIsDefined) {
  const Case disk = onDisk(1000);
  const Eigen::Index n = disk.points.rows();
  Points points(n + 503, 3);
  points.topRows(n) = disk.points;
  points.middleRows(n, 500) = 0.3 * shapes::sphere(500).points;
  points.middleRows(n, 500).col(0).array() += 5;
  points.row(n + 500) = points.row(7);
  points.row(n + 501).setConstant(NAN);
  points.row(n + 502) << 1e6, 0, 0;
  const Laplacian laplacian = orientedCloud(points);
  std::vector<int> curve = disk.curve;
  curve.insert(curve.begin() + 3, static_cast<int>(n) + 501);  // takes no part
  SignedDistanceReport report;
  const VectorXd distance = SignedDistanceSolver(laplacian).query(curve, &report);
  support::expectCopies(laplacian, distance);
  EXPECT_TRUE(distance.head(n).allFinite());
  EXPECT_TRUE(distance.segment(n, 500).array().isNaN().all());
  EXPECT_TRUE(distance.tail(2).array().isNaN().all());
  EXPECT_NEAR(report.curve_length, M_PI, 0.01);
  EXPECT_EQ(report.curve_points, std::ssize(disk.curve) - 1);
}

TEST(SignedDistance, CountsSegmentsThatSkipPoints) {
  const Case ball = onSphere(2000);
  const Laplacian laplacian = orientedCloud(ball.points);
  SignedDistanceReport report;
  for (const DistanceMethod method : {DistanceMethod::heat, DistanceMethod::marching}) {
    const SignedDistanceSolver solver(laplacian, {.method = method});
    solver.query(ball.curve, &report);
    EXPECT_EQ(report.segments, std::ssize(ball.curve) - 1);
    EXPECT_EQ(report.long_segments, 0);
    EXPECT_EQ(longSegmentsWarning(report), "");
    const int opposite = ball.curve[ball.curve.size() / 2];
    solver.query({ball.curve[0], ball.curve[1], opposite, opposite + 1}, &report);
    EXPECT_EQ(report.segments, 3);
    EXPECT_EQ(report.long_segments, 1);
    EXPECT_EQ(longSegmentsWarning(report).rfind("1 of the 3 segments", 0), 0u);
  }
}

TEST(SignedDistance, NamesWhatACallerGotWrong) {
  const shapes::Mesh square = shapes::gridSquare(4);
  const Laplacian laplacian = meshLaplacian(square.points, square.triangles);
  EXPECT_NE(refusal([&] { SignedDistanceSolver made(laplacian); }).find("frames"), std::string::npos);
  const SignedDistanceSolver solver(laplacian, meshFrames(square.points, square.triangles));
  EXPECT_EQ(refusal([&] { solver.query({0, 25}); }), "SignedDistanceSolver::query: source 25, must lie in [0, 25)");
  for (const std::vector<int>& curve : {std::vector<int>{}, {3}, {3, 3}})
    EXPECT_NE(refusal([&] { solver.query(curve); }).find("must have at least two on one component"), std::string::npos);
  EXPECT_THROW(solver.query({0, 1}, nullptr, [](std::string_view, double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace tufted::signed_distance_test
