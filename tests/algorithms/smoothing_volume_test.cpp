// Smoothing that keeps what a closed surface encloses: by scaling, and by Taubin's steps.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "shapes/shapes.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::smoothing_volume_test {
namespace {

/// Root mean square of how far points lie from the unit sphere.
double fromSphere(const Points& points) {
  return std::sqrt((points.rowwise().norm().array() - 1).square().mean());
}

/// The volume within triangles that turn outwards.
double volumeOf(const Points& points, const Triangles& triangles) {
  double sum = 0;
  for (const auto& t : triangles.rowwise()) sum += points.row(t[0]).dot(points.row(t[1]).cross(points.row(t[2]))) / 6;
  return sum;
}

shapes::Mesh bumpySphere() {
  shapes::Mesh mesh = shapes::icosphere(4);
  mesh.points = shapes::withNoise({.points = mesh.points}, 0.02).points;
  return mesh;
}

TEST(Smoothing, KeepsTheVolumeOfClosedSurfaces) {
  const shapes::Mesh mesh = bumpySphere();
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  const double before = volumeOf(mesh.points, mesh.triangles);
  for (const SmoothingMethod method : {SmoothingMethod::implicit, SmoothingMethod::taubin}) {
    SmoothingOptions options{.method = method, .time_step = 10, .iterations = 3};
    const double shrunk = volumeOf(smooth(laplacian, mesh.points, options), mesh.triangles);
    options.volume_of = &mesh.triangles;
    const Points kept = smooth(laplacian, mesh.points, options);
    EXPECT_NEAR(volumeOf(kept, mesh.triangles) / before, 1, 1e-12);
    if (method == SmoothingMethod::implicit) {
      EXPECT_LT(shrunk, 0.9 * before);
      EXPECT_LT(fromSphere(kept), fromSphere(mesh.points) / 2);
    }
  }
}

TEST(Smoothing, KeepsTheVolumeOfEachComponentInAnyUnit) {
  shapes::Mesh mesh = shapes::icosphere(3);
  const int n = static_cast<int>(mesh.points.rows());
  const Eigen::Index f = mesh.triangles.rows();
  mesh.points.conservativeResize(2 * n, 3);
  mesh.points.bottomRows(n) = (0.2 * mesh.points.topRows(n)).rowwise() + Eigen::RowVector3d(5, 0, 0);
  mesh.triangles.conservativeResize(2 * f, 3);
  mesh.triangles.bottomRows(f) = mesh.triangles.topRows(f).array() + n;
  for (const int exponent : {0, 300, -300}) {
    const Points points = std::ldexp(1, exponent) * mesh.points;
    const Laplacian laplacian = meshLaplacian(points, mesh.triangles);
    const Points x =
        std::ldexp(1, -exponent) * smooth(laplacian, points, {.time_step = 4, .volume_of = &mesh.triangles});
    const Points far = x.bottomRows(n).rowwise() - Eigen::RowVector3d(5, 0, 0);
    const Triangles sphere = mesh.triangles.topRows(f);
    EXPECT_NEAR(volumeOf(x.topRows(n), sphere), volumeOf(mesh.points.topRows(n), sphere), 1e-12) << exponent;
    EXPECT_NEAR(volumeOf(far, sphere), volumeOf(0.2 * mesh.points.topRows(n), sphere), 1e-13) << exponent;
  }
}

TEST(Smoothing, KeepsTheVolumeOfNoisyClouds) {
  CloudOptions noisy;
  noisy.steps.denoise = false;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Points points = shapes::withNoise(shapes::sphere(4000), 0.035, seed).points;
    const Laplacian laplacian = pointCloudLaplacian(points, noisy);
    const Triangles triangles = surfaceTriangles(laplacian);
    ASSERT_LT(triangles.rows(), 7990);  // holes
    const SmoothingOptions options{.time_step = 10, .volume_of = &triangles};
    EXPECT_NEAR(smooth(laplacian, points, options).rowwise().norm().mean(), 1, 1e-3);
  }
  const Points disk = shapes::disk(1000).points;
  const Laplacian open = pointCloudLaplacian(disk);
  const Triangles found = surfaceTriangles(open);
  EXPECT_EQ(support::refusal([&] { smooth(open, disk, {.volume_of = &found}); }),
            "smooth: the component of point 0 has a rim, must be closed");
}

TEST(Smoothing, ByTaubinHardlyShrinksASphere) {
  const Points points = shapes::sphere(4000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Points taubin = smooth(laplacian, points, {.method = SmoothingMethod::taubin, .iterations = 50});
  EXPECT_NEAR(taubin.rowwise().norm().mean(), 1, 2e-3);
  const Points plain = smooth(laplacian, points, {.method = SmoothingMethod::taubin, .mu = 0, .iterations = 50});
  EXPECT_LT(plain.rowwise().norm().mean(), 0.98);
}

TEST(Smoothing, ByTaubinDampsEigenvectorsAsItsPolynomialSays) {
  // D^-1 L of a ring is diagonal in waves: k = 1 - cos(2 pi f / n).
  const int n = 40;
  Laplacian ring;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2);
    entries.emplace_back(i, (i + 1) % n, -1);
    entries.emplace_back((i + 1) % n, i, -1);
  }
  ring.L.resize(n, n);
  ring.L.setFromTriplets(entries.begin(), entries.end());
  ring.M = VectorXd::Ones(n);
  ring.status.assign(n, PointStatus::active);
  ring.boundary.assign(n, Boundary::none);
  for (int i = 0; i < n; ++i) ring.representative.push_back(i);
  for (const int frequency : {1, 5, 20}) {
    Eigen::MatrixXd wave(n, 1);
    for (int i = 0; i < n; ++i) wave(i, 0) = std::cos(2 * M_PI * frequency * i / n);
    const double k = 1 - std::cos(2 * M_PI * frequency / n), factor = (1 - 0.4 * k) * (1 + 0.45 * k);
    const Eigen::MatrixXd found =
        smoothValues(ring, wave, {.method = SmoothingMethod::taubin, .lambda = 0.4, .mu = -0.45, .iterations = 3});
    EXPECT_LE((found - std::pow(factor, 3) * wave).cwiseAbs().maxCoeff(), 1e-13) << frequency;
  }
}

TEST(Smoothing, RefusesVolumesThatAreNotThere) {
  const auto why = [](const shapes::Mesh& mesh, SmoothingOptions options = {}) {
    options.volume_of = &mesh.triangles;
    return support::refusal([&] { smooth(meshLaplacian(mesh.points, mesh.triangles), mesh.points, options); });
  };
  EXPECT_EQ(why(shapes::gridSquare(3)), "smooth: the component of point 0 has a rim, must be closed");
  EXPECT_EQ(why(shapes::kleinBottle(8)), "smooth: the component of point 0 is nonorientable, must have two sides");
  EXPECT_EQ(why(shapes::book(3, 2)),
            "smooth: the component of point 0 has an edge of more than two triangles, must have none");
  const std::vector<std::uint8_t> fixed(42, 0);
  EXPECT_EQ(why(shapes::icosphere(1), {.fixed = &fixed}), "smooth: volume_of and fixed are given, must be one of both");
  EXPECT_EQ(why(shapes::icosphere(1), {.method = SmoothingMethod::taubin, .lambda = 1.5}),
            "smooth: lambda = 1.5, must lie in (0, 1]");
  EXPECT_EQ(why(shapes::icosphere(1), {.method = SmoothingMethod::taubin, .mu = 0.1}),
            "smooth: mu = 0.1, must lie in [-1, 0]");
  EXPECT_EQ(why(shapes::icosphere(1), {.method = SmoothingMethod::taubin, .lambda = 1, .mu = -1}),
            "smooth: lambda = 1 and mu = -1, must have (1 - 2 lambda) (1 - 2 mu) >= -1, or short waves grow");
}

}  // namespace
}  // namespace tufted::smoothing_volume_test
