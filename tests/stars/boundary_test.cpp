// Boundary tags: found where surfaces end and only there, and right about why.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/tufted.h"

namespace tufted::boundary_test {
namespace {

using shapes::Rim;
using shapes::Sampling;

/// Points of [first, last) with this tag.
int count(const Laplacian& laplacian, Boundary tag, int first, int last) {
  return static_cast<int>(std::count(laplacian.boundary.begin() + first, laplacian.boundary.begin() + last, tag));
}

int countAll(const Laplacian& laplacian, Boundary tag) {
  return count(laplacian, tag, 0, static_cast<int>(laplacian.boundary.size()));
}

int tagged(const Laplacian& laplacian) {
  return static_cast<int>(laplacian.boundary.size()) - countAll(laplacian, Boundary::none);
}

/// Tags that say that the first `rim` points are the rim, and nothing else: recall and precision.
void expectRim(const Laplacian& laplacian, int rim) {
  const int found = rim - count(laplacian, Boundary::none, 0, rim);
  EXPECT_GE(found, 0.95 * rim);
  EXPECT_GE(found, 0.95 * tagged(laplacian));
  EXPECT_EQ(countAll(laplacian, Boundary::rim), tagged(laplacian));
}

class Tags : public testing::TestWithParam<Preset> {
 protected:
  const CloudOptions options_ = cloudOptions(GetParam());
};

TEST_P(Tags, FindTheRimsOfShapesAndCallThemRims) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    for (const shapes::Cloud& cloud : {shapes::square(8000, Sampling::uniform, Rim::included, seed),
                                       shapes::disk(8000, Sampling::uniform, Rim::included, seed),
                                       shapes::cylinderPatch(8000, Sampling::uniform, Rim::included, seed),
                                       shapes::saddle(8000, Sampling::uniform, Rim::included, seed)}) {
      SCOPED_TRACE(cloud.shape + ", seed " + std::to_string(seed));
      expectRim(pointCloudLaplacian(cloud.points, options_), cloud.rim_points);
    }
  }
}

TEST_P(Tags, FindNothingOnClosedSurfaces) {
  for (const shapes::Cloud& cloud : {shapes::sphere(4000), shapes::sphere(4000, Sampling::nonuniform),
                                     shapes::sphere(4000, Sampling::jittered), shapes::torus(4000)}) {
    EXPECT_EQ(tagged(pointCloudLaplacian(cloud.points, options_)), 0) << cloud.shape << ", " << cloud.sampling;
  }
}

TEST_P(Tags, CallTheEdgeOfAHoleARimHoweverManyOutliersThereAre) {
  // A square with a round hole twelve spacings in radius, whose edge is sampled like the square's.
  const auto square =
      shapes::withOutliers(shapes::square(8000, Sampling::uniform, Rim::included), shapes::Outliers::near, 0.01);
  const double spacing = 1 / std::sqrt(8000), radius = 12 * spacing;
  const int around = static_cast<int>(2 * std::numbers::pi * 12);
  Points points(square.points.rows() + around, 3);
  int n = square.rim_points;
  points.topRows(n) = square.points.topRows(n);
  for (int i = 0; i < around; ++i) {
    const double angle = 2 * std::numbers::pi * i / around;
    points.row(n++) << 0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle), 0;
  }
  const int rim = n;
  for (Eigen::Index i = square.rim_points; i < square.points.rows(); ++i) {
    const double x = square.points(i, 0) - 0.5, y = square.points(i, 1) - 0.5;
    if (std::hypot(x, y) > radius + 0.3 * spacing) points.row(n++) = square.points.row(i);
  }
  const Laplacian laplacian = pointCloudLaplacian(points.topRows(n), options_);
  const int found = count(laplacian, Boundary::rim, 0, rim);
  EXPECT_GE(found, 0.95 * rim);
  EXPECT_GE(found, 0.95 * tagged(laplacian));
}

TEST_P(Tags, CallAnEdgeBeforeAnotherSurfaceAJump) {
  // A square six spacings in front of one twice its size. Nothing lies beyond the larger one.
  const auto front = shapes::square(8000, Sampling::uniform, Rim::included, 1);
  const auto back = shapes::square(32000, Sampling::uniform, Rim::included, 2);
  const int n = static_cast<int>(front.points.rows()), m = static_cast<int>(back.points.rows());
  Points points(n + m, 3);
  points << front.points, (2 * back.points).rowwise() + Eigen::RowVector3d(-0.5, -0.5, -6 / std::sqrt(8000));
  const Laplacian laplacian = pointCloudLaplacian(points, options_);
  EXPECT_GE(count(laplacian, Boundary::jump, 0, front.rim_points), 0.95 * front.rim_points);
  EXPECT_EQ(count(laplacian, Boundary::rim, n, n + back.rim_points), back.rim_points);
  EXPECT_LE(tagged(laplacian) - front.rim_points - back.rim_points, 0.05 * (front.rim_points + back.rim_points));
}

TEST_P(Tags, DependOnTheShapeAlone) {
  // Exact moves and powers of two, another order, other numbers of threads; the viewpoint moves along.
  auto image = shapes::depthCamera({.width = 80, .height = 60});
  const Points points = (image.points * 0x1p20).array().round() * 0x1p-20;
  const int n = static_cast<int>(points.rows());
  Eigen::Vector3d viewpoint(0, 0, 0);
  CloudOptions options = options_;
  options.viewpoint = &viewpoint;
  options.threads = 1;
  const std::vector<Boundary> tags = pointCloudLaplacian(points, options).boundary;
  options.threads = 4;
  EXPECT_EQ(pointCloudLaplacian(points, options).boundary, tags);
  const std::vector<int> source = shapes::Random(3).permutation(n);
  const std::vector<Boundary> of_permuted = pointCloudLaplacian(support::permuted(points, source), options).boundary;
  for (int i = 0; i < n; ++i) EXPECT_EQ(of_permuted[i], tags[source[i]]) << i;
  EXPECT_EQ(pointCloudLaplacian(0x1p27 * points, options).boundary, tags);
  viewpoint << 500000, 4000000, 100;
  EXPECT_EQ(pointCloudLaplacian(points.rowwise() + viewpoint.transpose(), options).boundary, tags);
}

TEST_P(Tags, TellRimsFromJumpsInADepthImageSeenFromTheCamera) {
  const shapes::DepthCameraOptions camera{.width = 160, .height = 120};
  shapes::DepthCameraOptions exact = camera;
  exact.depth_step = exact.dropouts = 0;
  const shapes::ImageEdges edges = shapes::imageEdges(shapes::depthCamera(exact));
  const auto beside = [&](const std::vector<std::uint8_t>& marks) { return shapes::widened(marks, camera.width, 1); };
  const auto beside_rim = beside(edges.rim), beside_other = beside(edges.other);
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  CloudOptions options = options_;
  options.viewpoint = &origin;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Laplacian laplacian = pointCloudLaplacian(shapes::depthCamera(camera, seed).points, options);
    const int n = static_cast<int>(laplacian.boundary.size());
    std::vector<std::uint8_t> rim(n), jump(n);
    for (int i = 0; i < n; ++i) {
      rim[i] = laplacian.boundary[i] == Boundary::rim ? 1 : 0;
      jump[i] = laplacian.boundary[i] == Boundary::jump ? 1 : 0;
    }
    // A jump is found where the pixel or one beside it says so: at a slanted edge the pixels between two steps are
    // inside of the surface's triangles.
    const auto found_rim = beside(rim), found_jump = beside(jump);
    int rims = 0, jumps = 0, rims_found = 0, jumps_found = 0, right_rims = 0, right_jumps = 0;
    for (int i = 0; i < n; ++i) {
      right_rims += rim[i] & beside_rim[i];
      right_jumps += jump[i] & beside_other[i];
      if (laplacian.status[i] != PointStatus::active) continue;
      const bool only_rim = edges.rim[i] != 0 && beside_other[i] == 0;
      rims += only_rim ? 1 : 0;
      rims_found += only_rim && found_rim[i] != 0 ? 1 : 0;
      jumps += edges.jump[i];
      jumps_found += edges.jump[i] & found_jump[i];
    }
    EXPECT_GE(jumps, 100);
    EXPECT_GE(rims, 400);
    EXPECT_GE(rims_found, 0.95 * rims);
    EXPECT_GE(right_rims, 0.95 * static_cast<double>(laplacian.report.rim_points));
    EXPECT_GE(jumps_found, 0.95 * jumps);
    EXPECT_GE(right_jumps, 0.95 * static_cast<double>(laplacian.report.jump_points));
  }
}

TEST_P(Tags, AreTheOnlyThingAViewpointChanges) {
  const Points points = shapes::depthCamera({.width = 80, .height = 60}).points;
  const Laplacian without = pointCloudLaplacian(points, options_);
  for (const Eigen::Vector3d& viewpoint :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(points.row(2000)), Eigen::Vector3d(1e300, -1e300, 1)}) {
    CloudOptions options = options_;
    options.viewpoint = &viewpoint;
    const Laplacian with = pointCloudLaplacian(points, options);
    EXPECT_TRUE(support::sameBits(with.L, without.L));
    EXPECT_TRUE(support::sameBits(with.M, without.M));
    for (std::size_t i = 0; i < with.boundary.size(); ++i) {
      EXPECT_TRUE(with.boundary[i] == Boundary::jump || with.boundary[i] == without.boundary[i]) << i;
      EXPECT_EQ(with.boundary[i] == Boundary::none, without.boundary[i] == Boundary::none) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, Tags, testing::Values(Preset::clean, Preset::scan));

TEST(LostTriangles, AreToldFromRimsWhereTheSurfaceGoesOn) {
  // Lines so far apart that the neighbours of some points do not surround them; nothing else ends on a sphere.
  const auto sphere = shapes::sphere(8000, Sampling::scanLines(20));
  const Laplacian laplacian = pointCloudLaplacian(sphere.points, cloudOptions(Preset::clean));
  EXPECT_GT(tagged(laplacian), 0);
  EXPECT_EQ(countAll(laplacian, Boundary::jump), 0);
  EXPECT_GE(countAll(laplacian, Boundary::lost), 2 * countAll(laplacian, Boundary::rim));
}

TEST(BoundaryTags, AreCountedAndSpareThePointsWithoutASurface) {
  const auto square = shapes::square(2000, Sampling::uniform, Rim::included);
  Points points(square.points.rows() + 3, 3);
  points << square.points, square.points.row(0), Eigen::RowVector3d::Constant(NAN), Eigen::RowVector3d(0.5, 0.5, 1000);
  const int n = static_cast<int>(points.rows());
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Report& report = laplacian.report;
  ASSERT_EQ(laplacian.status[n - 3], PointStatus::coincident);
  ASSERT_EQ(laplacian.status[n - 1], PointStatus::isolated);
  EXPECT_EQ(laplacian.boundary[n - 3], Boundary::rim);  // as point 0
  EXPECT_EQ(laplacian.boundary[n - 2], Boundary::none);
  EXPECT_EQ(laplacian.boundary[n - 1], Boundary::none);
  EXPECT_GE(report.rim_points, square.rim_points);
  EXPECT_EQ(report.rim_points, count(laplacian, Boundary::rim, 0, n - 3));
  EXPECT_EQ(report.jump_points, count(laplacian, Boundary::jump, 0, n - 3));
  EXPECT_EQ(report.lost_points, count(laplacian, Boundary::lost, 0, n - 3));
}

TEST(BoundaryTags, OfACallersNeighborhoodsComeFromThemAlone) {
  const auto square = shapes::square(1000, Sampling::uniform, Rim::included);
  Neighborhoods lists(square.points.rows(), 40);
  for (int p = 0; p < lists.rows(); ++p) {
    std::vector<std::pair<double, int>> all;
    for (int q = 0; q < lists.rows(); ++q) {
      if (q != p) all.emplace_back((square.points.row(q) - square.points.row(p)).squaredNorm(), q);
    }
    std::partial_sort(all.begin(), all.begin() + 40, all.end());
    for (int j = 0; j < 40; ++j) lists(p, j) = all[j].second;
  }
  expectRim(pointCloudLaplacian(square.points, {.neighborhoods = &lists}), square.rim_points);

  const int last = static_cast<int>(lists.rows()) - 1;
  lists.row(last).tail(39).setConstant(-1);  // one neighbour, no triangle
  const Laplacian laplacian = pointCloudLaplacian(square.points, {.neighborhoods = &lists});
  EXPECT_EQ(laplacian.status[last], PointStatus::active);  // others name it
  EXPECT_EQ(laplacian.boundary[last], Boundary::lost);
}

TEST(BoundaryTags, OfAMeshAreTheVerticesOfItsFreeEdges) {
  const auto mesh = shapes::gridSquare(10);
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  for (int i = 0; i < mesh.points.rows(); ++i) {
    const bool inside = (mesh.points.row(i).head<2>().array() > 0).all() && (mesh.points.row(i).array() < 1).all();
    EXPECT_EQ(laplacian.boundary[i], inside ? Boundary::none : Boundary::rim) << i;
  }
  EXPECT_EQ(laplacian.report.rim_points, 40);
  EXPECT_EQ(laplacian.report.jump_points + laplacian.report.lost_points, 0);
}

TEST(BoundaryTags, RefuseAViewpointThatIsNotFinite) {
  const Eigen::Vector3d viewpoint(0, NAN, 0);
  try {
    pointCloudLaplacian(shapes::sphere(100).points, {.viewpoint = &viewpoint});
    FAIL() << "a viewpoint of NaN was taken";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("pointCloudLaplacian: viewpoint = "), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("must be finite"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace tufted::boundary_test
