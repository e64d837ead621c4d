#include "tufted/denoise.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "shapes/distances.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/errors.h"

namespace tufted::denoise_test {
namespace {

using shapes::Cloud;
using shapes::rmsDistance;
using shapes::Sampling;
using shapes::toCube;
using shapes::toSphere;
using shapes::toTorus;

constexpr int n = 8000;

Points noisySphere(double sigma, std::uint64_t seed = 1) {
  return withNoise(shapes::sphere(n, Sampling::uniform, seed), sigma, seed + 100).points;
}

TEST(Denoise, LeavesExactPointsBitForBit) {
  for (const Cloud& cloud :
       {shapes::sphere(n), shapes::torus(n), shapes::cubeSurface(n), shapes::cylinderPatch(n), shapes::saddle(n),
        shapes::crossingPlanes(n), shapes::squareLattice(), shapes::sphere(n, Sampling::scanLines(20)),
        shapes::sphere(n, Sampling::densityStep(16))}) {
    const DenoisedPoints done = denoise(cloud.points);
    EXPECT_EQ(done.report.moved, 0) << cloud.name;
    EXPECT_TRUE(done.positions == cloud.points) << cloud.name;
    EXPECT_TRUE(done.noise.isZero(0)) << cloud.name;
  }
}

TEST(Denoise, BringsPointsToTheSurface) {
  for (const double sigma : {0.005, 0.01, 0.02, 0.04}) {
    const Points sphere = noisySphere(sigma);
    EXPECT_LT(rmsDistance(denoise(sphere).positions, toSphere), 0.25 * rmsDistance(sphere, toSphere)) << sigma;
    const Points torus = withNoise(shapes::torus(n), sigma / 2, 7).points;
    EXPECT_LT(rmsDistance(denoise(torus).positions, toTorus), 0.32 * rmsDistance(torus, toTorus)) << sigma;
  }
}

// Without fits of 256 points .065 and .10 spacings are left.
TEST(Denoise, BringsPointsNearToATorus) {
  const Cloud torus = shapes::torus(16000, Sampling::uniform, 1);
  const double spacing = std::sqrt(torus.area / 16000);
  EXPECT_LT(rmsDistance(denoise(withNoise(torus, 0.01, 7).points).positions, toTorus), 0.058 * spacing);
  EXPECT_LT(rmsDistance(denoise(withNoise(torus, 0.02, 7).points).positions, toTorus), 0.088 * spacing);
}

TEST(Denoise, KeepsCreases) {
  const Points cube = withNoise(shapes::cubeSurface(n), 0.01, 7).points;
  const Points done = denoise(cube).positions;
  EXPECT_LT(rmsDistance(done, toCube), 0.4 * rmsDistance(cube, toCube));
  double sum = 0;  // how far inside points are that belong next to an edge: rounding would put them there
  int count = 0;
  const Points exact = shapes::cubeSurface(n).points;
  for (int i = 0; i < n; ++i) {
    const Eigen::Array3d to_faces = 0.5 - (exact.row(i).transpose().array() - 0.5).abs();
    if ((to_faces < 0.02).count() < 2) continue;
    sum += toCube(done.row(i));
    ++count;
  }
  ASSERT_GT(count, 500);
  EXPECT_GT(sum / count, -0.005);
}

/// Waves of 8 spacings, half a spacing high, which bend within windows of 64 points but not within those of 32.
double waves(const Eigen::RowVector3d& x) {
  const double spacing = 1 / std::sqrt(n), turn = 2 * std::numbers::pi / (8 * spacing);
  return spacing / 2 * std::sin(turn * x[0]) * std::sin(turn * x[1]);
}

Points noisyWaves(double sigma) {
  Points points = shapes::square(n, Sampling::uniform, shapes::Rim::included).points;
  for (int i = 0; i < n; ++i) points(i, 2) = waves(points.row(i));
  shapes::Random random(7);
  for (double& z : points.col(2)) z += sigma * random.normal();
  return points;
}

// Windows of 64 points flatten waves, and windows of each point alone keep a third of the height and .62 of the noise.
TEST(Denoise, BringsPointsToSurfacesThatBend) {
  const Points points = noisyWaves(0.36 / std::sqrt(n));
  const auto off = [](const Eigen::RowVector3d& x) { return x[2] - waves(x); };
  const Points done = denoise(points).positions;
  EXPECT_LT(rmsDistance(done, off), 0.55 * rmsDistance(points, off));
  double along = 0, all = 0;
  for (int i = 0; i < n; ++i) {
    along += done(i, 2) * waves(points.row(i));
    all += waves(points.row(i)) * waves(points.row(i));
  }
  EXPECT_GT(along, 0.5 * all);
}

TEST(Denoise, LeavesARimThatIsInItsPlace) {
  for (const shapes::Rim rim : {shapes::Rim::included, shapes::Rim::none}) {
    Points square = shapes::square(n, Sampling::uniform, rim).points;
    square.col(2) = withNoise(shapes::square(n, Sampling::uniform, rim), 0.5 / std::sqrt(n), 7).points.col(2);
    const DenoisedPoints done = denoise(square);
    EXPECT_GT(done.report.moved, n * 9 / 10);
    EXPECT_LT((done.positions - square).leftCols(2).norm() / std::sqrt(n), 0.05 / std::sqrt(n));
  }
}

TEST(Denoise, SaysHowStrongTheNoiseIs) {
  for (const double sigma : {0.002, 0.005, 0.01, 0.02}) {
    const DenoisedPoints done = denoise(noisySphere(sigma));
    EXPECT_NEAR(done.report.noise, sigma, 0.15 * sigma);
    EXPECT_EQ((done.noise.array() > 0).count(), done.report.moved);
  }
}

TEST(Denoise, KeepsSheetsApart) {
  const double spacing = std::sqrt(2.0 / n);
  for (const int spacings : {4, 8}) {
    const double distance = spacings * spacing;
    const Cloud sheets = withNoise(shapes::twoSheets(n, distance), 0.25 * spacing, 7);
    const Points done = denoise(sheets.points).positions;
    double farthest = 0;
    for (int i = 0; i < n; ++i) farthest = std::max(farthest, std::abs(done(i, 2) - distance * sheets.labels[i]));
    EXPECT_LT(farthest, 0.3 * distance) << spacings;
  }
}

TEST(Denoise, LeavesOutliersAlone) {
  const Cloud cloud = withNoise(withOutliers(shapes::sphere(n), shapes::Outliers::far, 0.01, 3), 0.005, 7);
  const DenoisedPoints done = denoise(cloud.points);
  int far = 0;
  for (int i = n; i < cloud.points.rows(); ++i) {
    if (std::abs(toSphere(cloud.points.row(i))) < 0.1) continue;  // some lie on the sphere
    EXPECT_TRUE(done.positions.row(i) == cloud.points.row(i)) << i;
    ++far;
  }
  EXPECT_GT(far, 50);  // of 80
  EXPECT_GT(done.report.outliers, 0);
  EXPECT_LT(rmsDistance(done.positions.topRows(n), toSphere), 0.002);
}

/// Points of curves, each a turn of 2 pi long in its parameter, with normal noise in all directions.
/// @param noise in distances of neighbours along the curve, about
template <class Curve>
Points along(const Curve& curve, int count, double noise, std::uint64_t seed) {
  shapes::Random random(seed);
  Points points(count, 3);
  for (int i = 0; i < count; ++i) points.row(i) = curve(2 * std::numbers::pi * i / count);
  const double spacing = (points.row(1) - points.row(0)).norm();
  if (noise > 0)
    for (double& x : points.reshaped()) x += noise * spacing * random.normal();
  return points;
}

TEST(Denoise, LeavesCurvesAlone) {
  using Row = Eigen::RowVector3d;
  const auto line = [](double t) { return Row(t, 2 * t, -t); };
  const auto circle = [](double t) { return Row(std::cos(t), std::sin(t), 0.3 * std::cos(t)); };
  const auto helix = [](double t) { return Row(std::cos(2 * t), std::sin(2 * t), 8 * t); };
  const auto knot = [](double t) {
    return Row((2 + std::cos(3 * t)) * std::cos(2 * t), (2 + std::cos(3 * t)) * std::sin(2 * t), std::sin(3 * t));
  };
  for (const int count : {1000, 3000}) {
    for (const double noise : {0., 0.1, 0.5, 2.}) {
      for (const Points& points : {along(line, count, noise, 111), along(circle, count, noise, 112),
                                   along(helix, count, noise, 113), along(knot, count, noise, 114)})
        EXPECT_EQ(denoise(points).positions, points) << count << " points with noise of " << noise << " spacings";
    }
    EXPECT_EQ(denoise(along(circle, count, 0.1, 112)).report.no_surface, count);
  }
}

TEST(Denoise, TakesNoScanLinesForCurves) {
  const shapes::Cloud lines = shapes::sphere(16000, Sampling::scanLines(20));
  const double half_spacing = std::sqrt(std::numbers::pi / 16000);
  for (const std::uint64_t seed : {201, 202, 203}) {
    const DenoisedPoints done = denoise(withNoise(lines, half_spacing, seed).points);
    EXPECT_EQ(done.report.no_surface, 0);
    EXPECT_LT(rmsDistance(done.positions, toSphere), 0.15 * half_spacing);
  }
}

TEST(Denoise, LeavesTightHelicesAlone) {
  // 30 points a turn and turns as far apart as the radius: 32 neighbours are a ring, and 64 look like a thick surface.
  const Points helix =
      along([](double t) { return Eigen::RowVector3d(std::cos(10 * t), std::sin(10 * t), 8 * t / 6.3); }, 300, 0, 1);
  EXPECT_EQ(denoise(helix).positions, helix);
}

TEST(Denoise, LeavesVolumesAlone) {
  shapes::Random random(103);
  for (const int count : {1000, 2000, 20000}) {
    Points cube(count, 3), ball(count, 3);
    for (double& x : cube.reshaped()) x = random.uniform();
    for (int i = 0; i < count;) {
      for (int axis = 0; axis < 3; ++axis) ball(i, axis) = random.uniform(-1, 1);
      if (ball.row(i).norm() < 1) ++i;
    }
    Points noisy = ball;
    for (double& x : noisy.reshaped()) x += std::cbrt(1.0 / count) * random.normal();
    for (const Points& points : {cube, ball}) {
      const DenoisedPoints done = denoise(points);
      EXPECT_LE(done.report.moved, 0.002 * count) << count;  // chance makes thin layers of a few
      EXPECT_GT(done.report.no_surface, 0.99 * count) << count;
    }
    EXPECT_LT(denoise(noisy).report.moved, 0.05 * count) << count;  // some of its outskirts look like a surface
  }
}

TEST(Denoise, MovesAsTheCloudDoes) {
  const Points points = noisySphere(0.01);
  const DenoisedPoints done = denoise(points);
  ASSERT_GT(done.report.moved, n * 9 / 10);

  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(5));
  EXPECT_TRUE(denoise(points(order, Eigen::all)).positions == done.positions(order, Eigen::all));

  EXPECT_TRUE(denoise(1024 * points).positions == 1024 * done.positions);

  // Fits are stored as floats.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Points turned = denoise(points * turn).positions * turn.transpose();
  EXPECT_LT((turned - done.positions).cwiseAbs().maxCoeff(), 1e-8);

  const Eigen::RowVector3d far(4096, -8192, 2048);
  const Points rounded = (points.rowwise() + far).rowwise() - far;
  EXPECT_LT((denoise(points.rowwise() + far).positions - (denoise(rounded).positions.rowwise() + far)).norm(), 1e-9);
}

TEST(Denoise, HasTheSameBitsForAnyNumberOfThreads) {
  const Points cube = withNoise(shapes::cubeSurface(4000), 0.01, 7).points;  // many blocks
  const Points open = withNoise(shapes::square(8000, Sampling::uniform, shapes::Rim::included), 0.006, 7).points;
  for (const Points& points : {cube, open, noisyWaves(0.36 / std::sqrt(n))}) {
    const Points one = denoise(points, {.threads = 1}).positions;
    for (const int threads : {2, 3, 7}) EXPECT_TRUE(denoise(points, {.threads = threads}).positions == one) << threads;
  }
}

TEST(Denoise, OfOddDataIsDefined) {
  Points points = noisySphere(0.01);
  points.row(3).setConstant(NAN);
  points(5, 1) = INFINITY;
  points.row(9) = points.row(7);
  const DenoisedPoints done = denoise(points);
  EXPECT_EQ(done.report.not_finite, 2);
  EXPECT_EQ(done.report.coincident, 1);
  EXPECT_TRUE(std::isnan(done.positions(3, 0)));
  EXPECT_EQ(done.positions(5, 1), INFINITY);
  EXPECT_TRUE(done.positions.row(9) == done.positions.row(7));
  EXPECT_EQ(done.noise[9], done.noise[7]);
  EXPECT_GT(done.report.moved, n * 9 / 10);
  EXPECT_LE(done.report.mean_move, done.report.farthest_move);

  for (const int few : {0, 1, 2, 3, 16, 32, 33, 64, 65, 129, 257}) {
    const Points some = points.bottomRows(few);
    EXPECT_TRUE(denoise(some).positions.allFinite()) << few;
    EXPECT_TRUE(few > 32 || denoise(some).positions == some) << few;
  }
  for (const int few : {40, 70, 300}) {  // lines, whose neighbourhoods grow as far as there are points
    const Points rings = shapes::sphere(few, Sampling::scanLines(40)).points;
    EXPECT_TRUE(denoise(rings).positions.allFinite()) << few;
  }
  Points line = Points::Zero(500, 3), same = Points::Ones(500, 3);
  for (int i = 0; i < 500; ++i) line(i, 0) = i;
  EXPECT_TRUE(denoise(line).positions == line);
  EXPECT_TRUE(denoise(same).positions == same);
  for (const double scale : {1e-100, 1e100}) {
    const Points scaled = scale * noisySphere(0.01);
    const DenoisedPoints there = denoise(scaled);
    EXPECT_LT(rmsDistance(there.positions / scale, toSphere), 0.003) << scale;
    EXPECT_NEAR(there.report.noise / scale, 0.01, 0.0015) << scale;
  }
}

TEST(Denoise, RefusesMistakesAndCanBeCancelled) {
  const Points points = noisySphere(0.01);
  try {
    denoise(points, {.threads = -1});
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "denoise: threads is -1, must be at least 0");
  }
  EXPECT_THROW(denoise(points, {.progress = [](std::string_view, double) { return false; }}), Cancelled);
}

}  // namespace
}  // namespace tufted::denoise_test
