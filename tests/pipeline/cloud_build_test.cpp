// L and M from the stars themselves against those from the whole cover.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/build.h"
#include "shapes/shapes.h"

namespace tufted::cloud_build_test {
namespace {

/// The largest difference of two matrices over the larger diagonal, row by row and column by column.
double largestDifference(const SparseMatrix& a, const SparseMatrix& b) {
  const VectorXd diagonal = VectorXd(a.diagonal()).cwiseMax(VectorXd(b.diagonal()));
  const SparseMatrix difference = a - b;
  double largest = 0;
  for (int j = 0; j < difference.cols(); ++j) {
    for (SparseMatrix::InnerIterator it(difference, j); it; ++it) {
      if (it.value() != 0)
        largest = std::max(largest, std::abs(it.value()) / std::max(diagonal[it.row()], diagonal[it.col()]));
    }
  }
  return largest;
}

void expectSame(const std::string& name, const Points& points, const CloudOptions& options) {
  Laplacian fast, plain;
  buildCloudLaplacian(points, options, CloudBuild::automatic, fast);
  buildCloudLaplacian(points, options, CloudBuild::whole_cover, plain);
  EXPECT_LE(largestDifference(fast.L, plain.L), fast.report.flips + plain.report.flips == 0 ? 1e-12 : 1e-9) << name;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    ASSERT_NEAR(fast.M[i], plain.M[i], 1e-9 * plain.M[i]) << name << " point " << i;
    ASSERT_NEAR(fast.cover_areas[i], plain.cover_areas[i], 1e-9 * plain.cover_areas[i]) << name << " point " << i;
  }
  EXPECT_EQ(fast.status, plain.status) << name;
  EXPECT_EQ(fast.boundary, plain.boundary) << name;
  EXPECT_EQ(fast.report.triangles, plain.report.triangles) << name;
  EXPECT_EQ(fast.report.components, plain.report.components) << name;
  EXPECT_EQ(fast.report.degenerate_faces, plain.report.degenerate_faces) << name;
  EXPECT_NEAR(fast.report.mean_edge, plain.report.mean_edge, 1e-12 * plain.report.mean_edge) << name;
  // Rounding in the lengths of thin triangles, which the short cut does not sum.
  EXPECT_NEAR(fast.report.area_added, plain.report.area_added, 1e-12 * plain.report.cover_area) << name;
  EXPECT_EQ(fast.report.star_masses, plain.report.star_masses) << name;
  EXPECT_EQ(fast.report.lengthened_edges, plain.report.lengthened_edges) << name;
  const CoverCheck check = validate(fast.cover());
  EXPECT_TRUE(check.ok()) << name;
  EXPECT_EQ(fast.cover().size(), plain.cover().size()) << name;
}

TEST(CloudBuild, FromStarsEqualsTheWholeCover) {
  for (const Preset preset : {Preset::clean, Preset::scan, Preset::lidar}) {
    for (const auto& cloud : shapes::allClouds(1500)) expectSame(cloud.name, cloud.points, cloudOptions(preset));
  }
}

TEST(CloudBuild, IsTheSameOnNoise) {
  for (const double noise : {0.002, 0.005, 0.05}) {
    for (const Preset preset : {Preset::clean, Preset::scan})
      expectSame("noise " + std::to_string(noise), shapes::withNoise(shapes::sphere(4000), noise).points,
                 cloudOptions(preset));
  }
}

TEST(CloudBuild, IsTheSameInManyBlocks) {
  for (const Preset preset : {Preset::clean, Preset::scan})
    expectSame("blocks", shapes::withNoise(shapes::sphere(40000), 0.005).points, cloudOptions(preset));
}

}  // namespace
}  // namespace tufted::cloud_build_test
