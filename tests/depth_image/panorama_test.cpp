// Images whose rays are no pinhole's: a scanner that turns, with the same angle from pixel to pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "depth_image/image.h"
#include "shapes/random.h"
#include "tufted/spectrum.h"

namespace tufted::panorama_test {
namespace {

constexpr int columns = 180, rows = 120;
constexpr double step = std::numbers::pi / 360;  // half a degree, so 90 by 60 degrees
constexpr double wall = 2;                       // where x is that

Eigen::RowVector3d rayOf(int pixel) {
  const double azimuth = (pixel % columns - columns / 2) * step, elevation = (pixel / columns - rows / 2) * step;
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

/// What is seen where the ray of a pixel is `range(ray)` long, with noise of the inverse range.
Points panorama(const std::function<double(const Eigen::RowVector3d&)>& range, double noise = 0, int seed = 1) {
  shapes::Random random(seed);
  Points points(rows * columns, 3);
  for (int i = 0; i < points.rows(); ++i) {
    const Eigen::RowVector3d ray = rayOf(i);
    points.row(i) = ray / (1 / range(ray) + noise * random.normal());
  }
  return points;
}

double wallRange(const Eigen::RowVector3d& ray) {
  return wall / ray[0];
}

Laplacian laplacianOf(const Points& points) {
  return image_tests::imageLaplacian(points, columns, rows);
}

bool isAtRim(int pixel) {
  const int row = pixel / columns, column = pixel % columns;
  return std::min({row, column, rows - 1 - row, columns - 1 - column}) == 0;
}

TEST(Panorama, OfAWallIsAPlane) {
  const Points points = panorama(wallRange);
  const Laplacian laplacian = laplacianOf(points);
  EXPECT_EQ(laplacian.report.denoised, 0);
  EXPECT_EQ(laplacian.positions, points);
  const Eigen::MatrixX3d residual = laplacian.L * points;
  for (int i = 0; i < points.rows(); ++i) {
    if (isAtRim(i)) continue;
    ASSERT_LT(residual.row(i).norm(), 1e-9) << i;
  }
}

/// The image's own triangles, two to a cell.
Laplacian meshOf(const Points& points) {
  Triangles triangles(2 * (columns - 1) * (rows - 1), 3);
  for (int i = 0; i < triangles.rows(); ++i) {
    const int cell = i / 2, here = cell / (columns - 1) * columns + cell % (columns - 1);
    if (i % 2 == 0)
      triangles.row(i) << here, here + 1, here + columns;
    else
      triangles.row(i) << here + 1, here + columns + 1, here + columns;
  }
  return meshLaplacian(points, triangles);
}

TEST(Panorama, OfASphereFromWithinHasItsAreaAndSpectrum) {
  const double radius = 3;
  const Points points = panorama([&](const Eigen::RowVector3d&) { return radius; });
  const Laplacian laplacian = laplacianOf(points);
  const double highest = (rows / 2 - 1) * step, lowest = -rows / 2 * step;
  const double area = radius * radius * (columns - 1) * step * (std::sin(highest) - std::sin(lowest));
  EXPECT_NEAR(laplacian.M.sum(), area, 1e-3 * area);
  EXPECT_NEAR(laplacian.cover_areas.sum(), area, 1e-3 * area);
  const SpectrumOptions options{.null_space = false};
  const VectorXd values = spectrum(laplacian, 10, options).values, truth = spectrum(meshOf(points), 10, options).values;
  EXPECT_LT((values.cwiseQuotient(truth).array() - 1).abs().maxCoeff(), 2e-3);
}

TEST(Panorama, OfANoisyWallIsNearlyThatOfTheWall) {
  const double noise = 2e-3;  // 8 mm at 2 m, half of a pixel there
  const Points points = panorama(wallRange, noise), exact = panorama(wallRange);
  const Laplacian laplacian = laplacianOf(points), truth = laplacianOf(exact);
  EXPECT_GT(laplacian.report.denoised, 0.95 * rows * columns);
  EXPECT_LT((laplacian.positions - exact).norm(), 0.4 * (points - exact).norm());
  EXPECT_NEAR(laplacian.M.sum(), truth.M.sum(), 0.01 * truth.M.sum());
}

TEST(Panorama, JoinsNothingAcrossAJump) {
  // A pillar of radius 0.2 m, 1 m away, before the wall.
  const auto pillarRange = [](const Eigen::RowVector3d& ray) {
    const double across = ray.head(2).squaredNorm(), along = ray[0];
    const double root = along * along - across * (1 - 0.04);
    return root < 0 ? INFINITY : (along - std::sqrt(root)) / across;
  };
  for (const double noise : {0.0, 1e-3}) {
    const Points points =
        panorama([&](const Eigen::RowVector3d& ray) { return std::min(pillarRange(ray), wallRange(ray)); }, noise);
    const Laplacian laplacian = laplacianOf(points);
    int on_pillar = 0;
    for (int i = 0; i < points.rows(); ++i) {
      if (pillarRange(rayOf(i)) == INFINITY) continue;
      ++on_pillar;
      for (SparseMatrix::InnerIterator it(laplacian.L, i); it; ++it) {
        EXPECT_LT(pillarRange(rayOf(static_cast<int>(it.row()))), INFINITY) << noise;
      }
    }
    EXPECT_GT(on_pillar, 5000);
    EXPECT_GT(laplacian.report.jump_points, 2 * rows);
  }
}

}  // namespace
}  // namespace tufted::panorama_test
