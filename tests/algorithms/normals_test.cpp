// Normals face the sensor, or agree on each component and point outwards.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "shapes/shapes.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::normals_test {
namespace {

/// The share of active points whose normal is on the side of the true one.
double outwardShare(const Laplacian& laplacian, const Points& normals, const Points& exact) {
  int outward = 0, active = 0;
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    if (laplacian.status[i] != PointStatus::active) continue;
    ++active;
    outward += normals.row(i).dot(exact.row(i)) > 0 ? 1 : 0;
  }
  return outward / static_cast<double>(active);
}

TEST(OrientedFrames, PointOutwardsOnClosedSurfaces) {
  const shapes::Cloud clouds[] = {shapes::sphere(16000), shapes::sphere(100), shapes::ellipsoid(16000),
                                  shapes::torus(16000), shapes::cubeSurface(16000)};
  for (const shapes::Cloud& cloud : clouds) {
    for (const double noise : {0.0, 0.01}) {
      const Laplacian laplacian = pointCloudLaplacian(shapes::withNoise(cloud, noise).points);
      EXPECT_EQ(laplacian.frames.orientation, Orientation::arbitrary);
      OrientationReport report;
      const Frames frames = orientedFrames(laplacian, {}, &report);
      EXPECT_GE(outwardShare(laplacian, frames.normals, cloud.normals), 0.999) << cloud.shape << ' ' << noise;
      EXPECT_EQ(frames.orientation, Orientation::consistent);
      EXPECT_EQ(report.components, laplacian.report.components);
      EXPECT_GT(report.turned, 0);
      for (Eigen::Index i = 0; i < cloud.points.rows(); ++i)
        EXPECT_LE(std::abs(frames.normals.row(i).dot(frames.tangents.row(i))), 1e-12);
    }
  }
}

TEST(OrientedFrames, OfSeveralComponentsAreOrientedOneByOne) {
  const Points points = shapes::twoSpheres(0.1);
  const Laplacian laplacian = pointCloudLaplacian(points);
  OrientationReport report;
  const Frames frames = orientedFrames(laplacian, {}, &report);
  EXPECT_EQ(report.components, 2);
  EXPECT_EQ(report.disagreeing_edges, 0);
  for (int part = 0; part < 2; ++part) {
    const Eigen::RowVector3d center = points.middleRows(1000 * part, 1000).colwise().mean();
    for (int i = 1000 * part; i < 1000 * (part + 1); ++i)
      EXPECT_GT(frames.normals.row(i).dot(points.row(i) - center), 0) << i;
  }
}

/// Clouds of unit spheres in a row, each of which touches the next.
shapes::Cloud touchingSpheres(int count, int points_each, std::uint64_t seed) {
  shapes::Cloud row = shapes::sphere(points_each, shapes::Sampling::uniform, seed);
  for (int i = 1; i < count; ++i) {
    const shapes::Cloud next = shapes::sphere(points_each, shapes::Sampling::uniform, seed + 1000 * i);
    row.points.conservativeResize(row.points.rows() + points_each, 3);
    row.points.bottomRows(points_each) = next.points.rowwise() + Eigen::RowVector3d(2.0 * i, 0, 0);
    row.normals.conservativeResize(row.points.rows(), 3);
    row.normals.bottomRows(points_each) = next.normals;
  }
  return row;
}

TEST(OrientedFrames, OfBodiesThatTouchPointOutwardsOnEach) {
  for (std::uint64_t seed = 101; seed <= 106; ++seed) {
    const shapes::Cloud row = touchingSpheres(seed % 2 == 0 ? 3 : 2, 3000, seed);
    const Laplacian laplacian = pointCloudLaplacian(row.points);
    ASSERT_EQ(laplacian.report.components, 1);
    EXPECT_GE(outwardShare(laplacian, orientedFrames(laplacian).normals, row.normals), 0.97) << seed;
  }
}

TEST(OrientedFrames, OfAPlanePointUp) {
  const Points plane = shapes::square(500).points;
  const Frames frames = orientedFrames(pointCloudLaplacian(plane));
  for (Eigen::Index i = 0; i < plane.rows(); ++i) EXPECT_GT(frames.normals(i, 2), 0.99);
}

// A valley and a hill are one open sheet seen from either side: neither has an outside.
TEST(OrientedFrames, OfOpenSheetsPointUpWhereUpIsGiven) {
  const Points square = shapes::square(2000).points;
  for (const double rise : {-0.5, -0.05, 0.0, 0.05, 0.5}) {
    Points sheet = square;
    for (Eigen::Index i = 0; i < sheet.rows(); ++i)
      sheet(i, 2) = rise * (std::pow(sheet(i, 0) - 0.5, 2) + std::pow(sheet(i, 1) - 0.5, 2));
    const Laplacian laplacian = pointCloudLaplacian(sheet);
    for (const Eigen::Vector3d& up : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.1, 0.2, -1e200)}) {
      OrientationReport report;
      const Frames frames = orientedFrames(laplacian, {.up = &up}, &report);
      EXPECT_EQ(report.open, 1);
      EXPECT_GT((frames.normals * up.stableNormalized()).minCoeff(), 0.5) << rise;
    }
    OrientationReport report;
    const Frames frames = orientedFrames(laplacian, {}, &report);
    EXPECT_EQ(report.open, 1);
    // To where it bulges, and as a plane where it hardly does.
    EXPECT_GT(frames.normals.col(2).mean() * (rise > 0.1 ? -1 : 1), 0.5) << rise;
  }
}

TEST(OrientedFrames, OfClosedSurfacesPointOutwardsWhateverIsUp) {
  const Eigen::Vector3d up(0, 0, 1);
  for (const shapes::Cloud& cloud : {shapes::sphere(3000), shapes::torus(3000)}) {
    const Laplacian laplacian = pointCloudLaplacian(cloud.points);
    OrientationReport report;
    const Frames frames = orientedFrames(laplacian, {.up = &up}, &report);
    EXPECT_EQ(report.open, 0);
    EXPECT_EQ(outwardShare(laplacian, frames.normals, cloud.normals), 1);
  }
}

TEST(OrientedFrames, OfOpenMeshesPointUpWhereUpIsGiven) {
  const shapes::Mesh grid = shapes::gridSquare(6);
  const Laplacian laplacian = meshLaplacian(grid.points, grid.triangles);
  for (const double z : {1.0, -1.0}) {
    const Eigen::Vector3d up(0, 0, z);
    OrientationReport report;
    const Frames frames = orientedFrames(laplacian, meshFrames(grid.points, grid.triangles), {.up = &up}, &report);
    EXPECT_EQ(report.open, 1);
    EXPECT_GT((z * frames.normals.col(2)).minCoeff(), 0.99);
  }
}

TEST(OrientedFrames, DisagreeSomewhereOnAMoebiusStrip) {
  const shapes::Mesh strip = shapes::moebius(12);
  const Laplacian laplacian = meshLaplacian(strip.points, strip.triangles);
  OrientationReport report;
  const Frames frames = orientedFrames(laplacian, meshFrames(strip.points, strip.triangles), {}, &report);
  EXPECT_GT(report.disagreeing_edges, 0);
  EXPECT_LE(report.disagreeing_edges, 50);  // one cut across the strip, which has 12 rows
  EXPECT_TRUE(frames.normals.allFinite());
}

TEST(OrientedFrames, DoNotDependOnTheSignsTheyComeWith) {
  const Points points = shapes::withNoise(shapes::torus(3000), 0.01).points;
  Laplacian laplacian = pointCloudLaplacian(points);
  const Frames frames = orientedFrames(laplacian);
  for (Eigen::Index i = 0; i < points.rows(); i += 3) laplacian.frames.normals.row(i) *= -1;
  EXPECT_EQ(orientedFrames(laplacian).normals, frames.normals);
}

/// The second tangent stays where a normal only changes its sign, and turns with a normal that turns a little.
TEST(OrientedFrames, KeepTheSecondTangent) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(1000).points);
  const Frames& before = laplacian.frames;
  const Frames frames = orientedFrames(laplacian);
  for (Eigen::Index i = 0; i < 1000; ++i) {
    const Eigen::RowVector3d normal = frames.normals.row(i), old = before.normals.row(i);
    const Eigen::RowVector3d second = normal.cross(frames.tangents.row(i)),
                             old_second = old.cross(before.tangents.row(i));
    if (normal == old || normal == -old) {
      EXPECT_EQ(second, old_second);
    } else {
      EXPECT_GE(second.dot(old_second), std::abs(normal.dot(old)) - 1e-12);
    }
  }
}

TEST(OrientedFrames, AreTheSameInAnyOrderUnitAndPlace) {
  const shapes::Cloud cloud = shapes::withNoise(shapes::torus(3000), 0.01), mixed = shapes::shuffled(cloud);
  const Frames first = orientedFrames(pointCloudLaplacian(mixed.points));
  EXPECT_EQ(outwardShare(pointCloudLaplacian(mixed.points), first.normals, mixed.normals), 1);
  for (const int exponent : {-400, 400}) {
    const Points scaled = cloud.points * std::ldexp(1.0, exponent);
    const Laplacian laplacian = pointCloudLaplacian(scaled);
    EXPECT_EQ(outwardShare(laplacian, orientedFrames(laplacian).normals, cloud.normals), 1) << exponent;
  }
  const Points far = cloud.points.rowwise() + Eigen::RowVector3d(1e6, -2e6, 3e6);
  const Laplacian laplacian = pointCloudLaplacian(far);
  EXPECT_EQ(outwardShare(laplacian, orientedFrames(laplacian).normals, cloud.normals), 1);
}

TEST(OrientedFrames, OfMeshesDoNotNeedOrientedTriangles) {
  shapes::Mesh ball = shapes::icosphere(3);
  for (Eigen::Index f = 0; f < ball.triangles.rows(); f += 2) std::swap(ball.triangles(f, 0), ball.triangles(f, 1));
  const Laplacian laplacian = meshLaplacian(ball.points, ball.triangles);
  const Frames frames = orientedFrames(laplacian, meshFrames(ball.points, ball.triangles));
  EXPECT_EQ(outwardShare(laplacian, frames.normals, ball.points), 1);
}

// Neighbours at a sharp edge say little about each other's side, triangles say it.
TEST(OrientedFrames, OfAMeshWithSharpEdgesAreThoseOfItsTriangles) {
  const Points corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  Triangles triangles{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                      {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  const auto inwards = [&](double height) {
    Points box = corners;
    box.col(2) *= height;
    const Points outward = box.rowwise() - box.colwise().mean();
    const Frames frames = orientedFrames(meshLaplacian(box, triangles), meshFrames(box, triangles));
    return (frames.normals.cwiseProduct(outward).rowwise().sum().array() <= 0).count();
  };
  for (const double height : {1.0, 0.1, 1e-3}) EXPECT_EQ(inwards(height), 0) << height;
  triangles.col(1).swap(triangles.col(2));  // all of them inside out
  for (const double height : {1.0, 0.1, 1e-3}) EXPECT_EQ(inwards(height), 0) << height;
}

TEST(OrientedFrames, OfANoisyPlanePointUp) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    const shapes::Cloud plane = shapes::square(4000, shapes::Sampling::uniform, shapes::Rim::included, seed);
    const Frames frames = orientedFrames(pointCloudLaplacian(shapes::withNoise(plane, 0.4 / 63, seed + 100).points));
    EXPECT_GT(frames.normals.col(2).mean(), 0.9) << seed;
  }
}

TEST(OrientedFrames, FaceTheViewpoint) {
  const Points points = shapes::torus(2000).points;
  const Eigen::Vector3d sensor(3, 1, 2);
  const auto facing = [&](const Frames& frames) {
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      if (frames.normals.row(i).dot(sensor.transpose() - points.row(i)) < 0) return false;
    return frames.orientation == Orientation::viewpoint;
  };
  CloudOptions options;
  EXPECT_FALSE(facing(pointCloudLaplacian(points, options).frames));
  EXPECT_TRUE(facing(orientedFrames(pointCloudLaplacian(points, options), {.viewpoint = &sensor})));
  options.viewpoint = &sensor;
  EXPECT_TRUE(facing(pointCloudLaplacian(points, options).frames));
  // The caller's normals keep their sign.
  const Points inwards = -shapes::torus(2000).normals;
  options.normals = &inwards;
  const Frames given = pointCloudLaplacian(points, options).frames;
  EXPECT_EQ(given.orientation, Orientation::given);
  for (Eigen::Index i = 0; i < points.rows(); ++i) EXPECT_GT(given.normals.row(i).dot(inwards.row(i)), 0);
}

TEST(OrientedFrames, OfADepthImageFaceItsOrigin) {
  const shapes::Cloud image = shapes::depthCamera({.width = 160, .height = 120});
  const ScanStructure structure = imageStructure(image.width, image.height);
  CloudOptions options;
  options.structure = &structure;
  const Laplacian laplacian = pointCloudLaplacian(image.points, options);
  EXPECT_EQ(laplacian.frames.orientation, Orientation::viewpoint);
  EXPECT_GE(outwardShare(laplacian, laplacian.frames.normals, image.normals), 0.99);
}

TEST(OrientedFrames, OfOddPointsAreDefined) {
  Points points = shapes::sphere(500).points;
  points.row(3).setConstant(NAN);
  points.row(9) = points.row(1);
  points.row(12) << 50, 50, 50;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Frames frames = orientedFrames(laplacian);
  EXPECT_TRUE(frames.normals.row(3).isZero(0));
  EXPECT_EQ(frames.normals.row(9), frames.normals.row(1));
  EXPECT_EQ(frames.tangents.row(9), frames.tangents.row(1));
  EXPECT_GT(frames.normals.row(1).dot(points.row(1)), 0);
  EXPECT_EQ(orientedFrames(pointCloudLaplacian(Points(0, 3))).normals.rows(), 0);
  EXPECT_EQ(orientedFrames(pointCloudLaplacian(Points::Zero(1, 3))).normals.rows(), 1);
}

TEST(OrientedFrames, RefuseWhatDoesNotFit) {
  const Points points = shapes::sphere(100).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const shapes::Mesh ball = shapes::icosphere(1);
  const auto refused = [](const Laplacian& l, const OrientationOptions& options = {}) {
    return support::refusal([&] { orientedFrames(l, options); });
  };
  EXPECT_EQ(refused(meshLaplacian(ball.points, ball.triangles)),
            "orientedFrames: frames.normals has 0 rows, must have 42; meshes have meshFrames()");
  Laplacian without = laplacian;
  without.positions = {};
  EXPECT_EQ(refused(without), "orientedFrames: Laplacian::positions has 0 rows, must have 100, one per point");
  Laplacian broken = laplacian;
  broken.frames.normals(7, 1) = NAN;
  EXPECT_EQ(refused(broken),
            "orientedFrames: the position or frame of point 7 is not finite, must be: the Laplacian "
            "has it active");
  const Eigen::Vector3d nowhere(0, NAN, 0);
  EXPECT_EQ(refused(laplacian, {.viewpoint = &nowhere}), "orientedFrames: viewpoint is not finite, must be");
  EXPECT_THROW(orientedFrames(laplacian, {.progress = [](std::string_view, double) { return false; }}), Cancelled);
}

}  // namespace
}  // namespace tufted::normals_test
