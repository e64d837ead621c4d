// What noise, rings, outliers and near sheets do to the operator, with the core's steps and with the preset for scans.
// The whole table, with three seeds, is tufted_scans.
#include <gtest/gtest.h>

#include "oracles/oracles.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/tufted.h"

namespace tufted::scans_test {
namespace {

double spectrumError(const shapes::Cloud& cloud, const CloudOptions& options, int eigenvalues) {
  const Laplacian laplacian = pointCloudLaplacian(cloud.points, options);
  return oracles::meanRelativeError(oracles::smallestEigenvalues(laplacian.L, laplacian.M, eigenvalues),
                                    cloud.eigenvalues.head(eigenvalues));
}

const CloudOptions clean = cloudOptions(Preset::clean), scan = cloudOptions(Preset::scan);

class Scans : public testing::TestWithParam<int> {};

TEST_P(Scans, NoiseOnASphereIsTamed) {
  const auto sphere = shapes::sphere(16000, shapes::Sampling::uniform, GetParam());
  EXPECT_LE(spectrumError(shapes::withNoise(sphere, 0.0025, GetParam()), scan, 30), 2.5e-3);
  EXPECT_LE(spectrumError(shapes::withNoise(sphere, 0.01, GetParam()), scan, 30), 9e-3);
  EXPECT_GE(spectrumError(shapes::withNoise(sphere, 0.01, GetParam()), clean, 30), 0.1);
}

TEST_P(Scans, NoiseOnACubeIsTamedAndItsCreasesStay) {
  const auto cube = shapes::cubeSurface(16000, GetParam());
  // The seed of the points would draw the same numbers, and the noise would not be white.
  EXPECT_LE(spectrumError(shapes::withNoise(cube, 0.01, GetParam() + 100), scan, 30), 1.3e-2);
  EXPECT_LE(spectrumError(cube, scan, 30), 1.02 * spectrumError(cube, clean, 30));
}

TEST_P(Scans, ACleanSphereIsNoWorse) {
  const auto sphere = shapes::sphere(16000, shapes::Sampling::uniform, GetParam());
  EXPECT_LE(spectrumError(sphere, scan, 30), 1.02 * spectrumError(sphere, clean, 30));
}

INSTANTIATE_TEST_SUITE_P(Seeds, Scans, testing::Values(1, 2, 3));

TEST(Scans, ScanLinesAreNoWorseThanTheHullOfTheirPoints) {
  for (const double anisotropy : {10.0, 20.0}) {
    const auto lines = shapes::sphere(16000, shapes::Sampling::scanLines(anisotropy));
    const auto [L, M] = oracles::cotanLaplacian(lines.points, oracles::convexHullMesh(lines.points));
    const double hull = oracles::meanRelativeError(oracles::smallestEigenvalues(L, M, 33), lines.eigenvalues.head(33));
    // Both are Delaunay; diagonals of what lies on one circle differ, by 2e-5, from one hull to the next too.
    EXPECT_LE(spectrumError(lines, scan, 33), (1 + 1e-4) * hull) << anisotropy;
  }
}

/// Lines that bend, far apart, lie in planes of their own, which are no sheets.
TEST(Scans, BentScanLinesFarApartAreOneSurface) {
  for (const double anisotropy : {10.0, 30.0}) {
    const auto torus = shapes::torus(4000, shapes::Sampling::scanLines(anisotropy), 101);
    const Laplacian laplacian = pointCloudLaplacian(torus.points, scan);
    EXPECT_EQ(laplacian.report.split_neighborhoods, 0) << anisotropy;
    EXPECT_EQ(laplacian.report.components, 1) << anisotropy;
    EXPECT_NEAR(laplacian.report.area, torus.area, 0.05 * torus.area) << anisotropy;
  }
}

TEST(Scans, TheMassIsPositiveAndKnowsBothAreas) {
  const auto torus = shapes::torus(16000);
  const Laplacian laplacian = pointCloudLaplacian(torus.points, scan);
  EXPECT_GT(laplacian.M.minCoeff(), 0);
  EXPECT_EQ(laplacian.report.area, laplacian.M.sum());
  EXPECT_EQ(laplacian.report.cover_area, laplacian.cover_areas.sum());
  EXPECT_NEAR(laplacian.report.area, torus.area, 1e-3 * torus.area);
  EXPECT_NEAR(laplacian.report.cover_area, torus.area, 1e-3 * torus.area);
  EXPECT_TRUE(support::sameBits(laplacian.M, laplacian.cover_areas));  // the surface ends nowhere
  const Laplacian open = pointCloudLaplacian(shapes::saddle(4000).points, scan);
  EXPECT_GT(open.report.star_masses, 0);
  for (Eigen::Index i = 0; i < open.M.size(); ++i)
    EXPECT_EQ(open.M[i] != open.cover_areas[i], open.boundary[i] != Boundary::none) << i;
  const Laplacian core = pointCloudLaplacian(torus.points, clean);
  EXPECT_TRUE(support::sameBits(core.M, core.cover_areas));
}

TEST_P(Scans, OutliersDoNotCount) {
  const auto sphere = shapes::sphere(16000, shapes::Sampling::uniform, GetParam());
  for (const auto where : {shapes::Outliers::near, shapes::Outliers::far}) {
    const auto cloud = shapes::withOutliers(sphere, where, 0.01, GetParam() + 100);
    const Laplacian laplacian = pointCloudLaplacian(cloud.points, scan);
    EXPECT_LE(spectrumError(cloud, scan, 49), 1e-2);
    EXPECT_NEAR(laplacian.report.area, sphere.area, 5e-3 * sphere.area);
    EXPECT_GT(laplacian.report.outliers, where == shapes::Outliers::far ? 100 : 0);
    for (int p = 0; p < 16000; ++p) ASSERT_EQ(laplacian.status[p], PointStatus::active);
    EXPECT_GE(pointCloudLaplacian(cloud.points, clean).report.area, 1.03 * sphere.area);
  }
}

TEST(Scans, SurfacesHaveNoOutliers) {
  constexpr int n = 16000;
  for (const auto& cloud :
       {shapes::sphere(n), shapes::cubeSurface(n), shapes::sphere(n, shapes::Sampling::densityStep(100)),
        shapes::twoSheets(n, 0.03), shapes::withNoise(shapes::torus(n), 0.01), shapes::square(n)})
    EXPECT_EQ(pointCloudLaplacian(cloud.points, scan).report.outliers, 0) << cloud.name;
  // Where planes cross, tangent planes stand askew.
  EXPECT_LE(pointCloudLaplacian(shapes::crossingPlanes(n).points, scan).report.outliers, n / 1000);
}

TEST(Scans, APointIsAnOutlierOverASurfaceButNotBesideIt) {
  Points points = shapes::squareLattice(40, 1).points;  // 40 x 40 points a unit apart
  const Eigen::RowVector3d corner = points.row(0), middle = points.colwise().mean();
  points.conservativeResize(1601, 3);
  CloudOptions options = scan;
  options.steps.split_sheets = false;
  points.row(1600) = middle + Eigen::RowVector3d(0, 0, 6);
  const Laplacian over = pointCloudLaplacian(points, options);
  EXPECT_EQ(over.status[1600], PointStatus::isolated);
  EXPECT_EQ(over.report.outliers, 1);
  options.steps.filter = Filter::radius;
  EXPECT_EQ(pointCloudLaplacian(points, options).status[1600], PointStatus::isolated);
  points.row(1600) = corner + Eigen::RowVector3d(-6, 0, 0);
  EXPECT_EQ(pointCloudLaplacian(points, options).report.outliers, 0);
}

TEST(Scans, PresetsDependOnTheShapeAlone) {
  // Exact moves and powers of two, another order and other numbers of threads: the same bits.
  Points points = shapes::withNoise(shapes::sphere(4000), 0.01).points;
  points = (points * 0x1p20).array().round() * 0x1p-20;
  for (const Preset preset : {Preset::clean, Preset::scan, Preset::lidar}) {
    CloudOptions options = cloudOptions(preset);
    options.threads = 1;
    const Laplacian reference = pointCloudLaplacian(points, options);
    const Points moved = points.rowwise() + Eigen::RowVector3d(500000, 4000000, 100);
    const Laplacian there = pointCloudLaplacian(moved, options);
    if (options.steps.denoise) {
      // Which points have windows that others share goes by the curve, which starts elsewhere: a part of the noise.
      EXPECT_NEAR(there.report.area, reference.report.area, 1e-3 * reference.report.area);
      options.steps.denoise = false;
      EXPECT_TRUE(support::sameBits(pointCloudLaplacian(moved, options).M, pointCloudLaplacian(points, options).M));
      options.steps.denoise = true;
    } else {
      EXPECT_TRUE(support::sameBits(there.M, reference.M));
    }
    EXPECT_TRUE(support::sameBits(pointCloudLaplacian(0x1p27 * points, options).L, reference.L));
    options.threads = 4;
    const Laplacian parallel = pointCloudLaplacian(points, options);
    EXPECT_TRUE(support::sameBits(parallel.L, reference.L));
    EXPECT_TRUE(support::sameBits(parallel.M, reference.M));
    const Points turned = points.colwise().reverse();
    const VectorXd M = pointCloudLaplacian(turned, options).M.reverse();
    EXPECT_TRUE(support::sameBits(M, reference.M));
  }
}

}  // namespace
}  // namespace tufted::scans_test
