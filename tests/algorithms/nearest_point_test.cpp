#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::nearest_point_test {
namespace {

TEST(NearestPoint, IsTheFirstActiveOne) {
  const Points points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.9, 0, 0}, {1, 0, 0}};
  const Laplacian laplacian = meshLaplacian(points, Triangles{{0, 1, 2}, {0, 4, 2}});
  EXPECT_EQ(nearestPoint(laplacian, points, {0.9, 0, 0}), 1);  // 3 is on no triangle
  EXPECT_EQ(nearestPoint(laplacian, points, {1e10, 0, 0}), 1);
  EXPECT_EQ(nearestPoint(laplacian, points, {1e300, 0, 0}), 0);  // all are as far
  EXPECT_EQ(nearestPoint(laplacian, points, {-1, 2, 0}), 2);
  EXPECT_THROW(nearestPoint(laplacian, points, {NAN, 0, 0}), InvalidInput);
  EXPECT_THROW(nearestPoint(laplacian, points.topRows(3), {0, 0, 0}), InvalidInput);
  EXPECT_THROW(nearestPoint(pointCloudLaplacian(Points(0, 3)), Points(0, 3), {0, 0, 0}), InvalidInput);
}

/// Expects for every position the nearest of all points, found by a linear scan.
void expectThoseOfALinearScan(const Laplacian& laplacian, const Points& points, const Points& positions) {
  const std::vector<int> found = nearestPoints(laplacian, points, positions);
  ASSERT_EQ(std::ssize(found), positions.rows());
  for (Eigen::Index k = 0; k < positions.rows(); ++k)
    ASSERT_EQ(found[k], nearestPoint(laplacian, points, positions.row(k).transpose())) << positions.row(k);
}

TEST(NearestPoints, AreThoseOfALinearScanAtAnySize) {
  // A lattice in random order, some of it twice or nowhere: at the centres of its cells four points tie, and more where
  // it is a mesh, whose copies all take part.
  shapes::Cloud lattice = shapes::squareLattice(30, 1);
  lattice.points.bottomRows(100) = lattice.points.topRows(100).eval();
  for (int i = 3; i < 900; i += 50) lattice.points(i, i % 3) = NAN;
  const Points points = shapes::shuffled(lattice).points;
  Triangles triangles(300, 3);
  for (int f = 0; f < 300; ++f) triangles.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
  Points positions(400, 3);
  shapes::Random random(1);
  for (int k = 0; k < 100; ++k) {
    const Eigen::RowVector3d corner(k / 10, k % 10, 0);
    positions.row(k) = corner;
    positions.row(100 + k) = corner + Eigen::RowVector3d(0.5, 0.5, k);
    positions.row(200 + k) = corner + Eigen::RowVector3d(0.5, 0, -k);
    for (int c = 0; c < 3; ++c) positions(300 + k, c) = random.uniform(-40, 40);
  }
  for (const double scale : {1.0, 0x1p-30, 0x1p-560, 0x1p400, 0x1p600}) {
    const Points scaled = scale * points, sought = scale * positions;
    Laplacian cloud = pointCloudLaplacian(points, {.keep_cover = false});
    Laplacian mesh = meshLaplacian(points, triangles, {.keep_cover = false});
    ASSERT_GT(mesh.report.active, 500);
    for (const Laplacian* laplacian : {&cloud, &mesh}) {
      expectThoseOfALinearScan(*laplacian, scaled, sought);
      expectThoseOfALinearScan(*laplacian, scaled, 1e5 * sought);
    }
  }
}

TEST(NearestPoints, AreThoseOfALinearScanForFewAndForOnePoint) {
  const Points points = shapes::sphere(100).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  expectThoseOfALinearScan(laplacian, points, 2 * points.topRows(5));
  expectThoseOfALinearScan(laplacian, points, Points(0, 3));
  Laplacian one = laplacian;
  for (int i = 0; i < 100; ++i) one.status[i] = i == 7 ? PointStatus::active : PointStatus::isolated;
  expectThoseOfALinearScan(one, points, points);
  expectThoseOfALinearScan(one, points, 1e300 * points);
}

TEST(NearestPoints, NameWhatACallerGotWrong) {
  Points points = shapes::sphere(100).points, positions = points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  positions(40, 1) = NAN;
  EXPECT_EQ(support::refusal([&] { nearestPoints(laplacian, points, positions); }),
            "nearestPoints: position 40 is not finite, must be");
  points(30, 2) = INFINITY;
  EXPECT_EQ(support::refusal([&] { nearestPoints(laplacian, points, Points::Zero(50, 3)); }),
            "nearestPoints: point 30 is not finite, must be: the Laplacian has it active");
  EXPECT_EQ(support::refusal([&] { nearestPoints(laplacian, points.topRows(99), positions); }),
            "nearestPoints: points has 99 rows, must have 100, one per point of the Laplacian");
}

TEST(NearestPoints, CancelAtEveryCall) {
  const Points points = shapes::sphere(500).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  for (const Eigen::Index count : {5, 3000}) {
    const Points positions = 2 * shapes::sphere(3000).points.topRows(count);
    int calls = 0;
    const auto askUntil = [&](int stop) {
      calls = 0;
      return nearestPoints(laplacian, points, positions, [&](std::string_view, double) { return ++calls < stop; });
    };
    EXPECT_EQ(askUntil(INT32_MAX), nearestPoints(laplacian, points, positions));
    const int all = calls;
    EXPECT_GE(all, 4) << count;
    for (int stop = 1; stop <= all; ++stop) EXPECT_THROW(askUntil(stop), Cancelled) << stop << " of " << all;
  }
}

}  // namespace
}  // namespace tufted::nearest_point_test
