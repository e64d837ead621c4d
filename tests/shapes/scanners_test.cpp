#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "shapes/shapes.h"

namespace tufted::shapes::scanners_test {
namespace {

using enum RoomSurface;

// Residual of the equation of the surface with a label, in the scanner's frame.
double offRoom(int label, const Eigen::RowVector3d& p) {
  switch (RoomSurface(label)) {
    case floor:
      return p.z() + 1.8;
    case ceiling:
      return p.z() - 2.2;
    case wall_west:
      return p.x() + 9;
    case wall_east:
      return p.x() - 11;
    case wall_south:
      return p.y() + 6;
    case wall_north:
      return p.y() - 9;
    case box_west:
      return p.x() - 3;
    case box_east:
      return p.x() - 5;
    case box_south:
      return p.y() + 3;
    case box_north:
      return p.y() + 1;
    case box_top:
      return p.z() + 0.3;
    case pole:
      return std::hypot(p.x() + 2.5, p.y() - 3) - 0.2;
  }
  return 1;
}

TEST(Scanners, LidarPointsLieOnTheirLabelledSurface) {
  for (const int rings : {16, 64}) {
    const Cloud cloud = lidar({.rings = rings, .azimuth_step = 1});
    EXPECT_EQ(cloud.width, 360);
    EXPECT_EQ(cloud.height, rings);
    std::set<int> seen;
    for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) {
      const Eigen::RowVector3d p = cloud.points.row(i);
      EXPECT_NEAR(offRoom(cloud.labels[i], p), 0, 1e-12);
      EXPECT_TRUE(p.x() > -9 - 1e-9 && p.x() < 11 + 1e-9 && p.y() > -6 - 1e-9 && p.y() < 9 + 1e-9);
      EXPECT_FALSE(p.x() > 3 + 1e-9 && p.x() < 5 - 1e-9 && p.y() > -3 + 1e-9 && p.y() < -1 - 1e-9 &&
                   p.z() < -0.3 - 1e-9);
      EXPECT_LT(cloud.normals.row(i).dot(p), 0);
      EXPECT_NEAR(cloud.normals.row(i).norm(), 1, 1e-12);
      seen.insert(cloud.labels[i]);
    }
    for (const RoomSurface surface : {floor, wall_west, wall_east, wall_south, wall_north, box_west, box_north, pole}) {
      EXPECT_TRUE(seen.contains(int(surface))) << int(surface);
    }
    EXPECT_FALSE(seen.contains(int(box_east)));  // behind the box
    EXPECT_FALSE(seen.contains(int(box_south)));
  }
}

TEST(Scanners, LidarRingsHaveOneElevation) {
  const Cloud cloud = lidar({.rings = 16, .azimuth_step = 0.4});
  for (int ring = 0; ring < 16; ++ring) {
    const double elevation = (-15 + 2 * ring) * std::atan(1.0) / 45;
    for (int column = 0; column < cloud.width; ++column) {
      const Eigen::RowVector3d p = cloud.points.row(ring * cloud.width + column);
      EXPECT_NEAR(std::atan2(p.z(), std::hypot(p.x(), p.y())), elevation, 1e-12);
    }
  }
}

TEST(Scanners, LidarNoiseRunsAlongTheBeam) {
  const Cloud clean = lidar({.azimuth_step = 0.5}), noisy = lidar({.azimuth_step = 0.5, .noise = 0.02});
  double sum = 0;
  for (Eigen::Index i = 0; i < clean.points.rows(); ++i) {
    const Eigen::RowVector3d step = noisy.points.row(i) - clean.points.row(i), beam = clean.points.row(i).normalized();
    EXPECT_NEAR(step.norm(), std::abs(step.dot(beam)), 1e-9);
    sum += step.squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(clean.points.rows())), 0.02, 1e-3);
}

TEST(Scanners, LidarsOf32RingsLookUpToTheCeiling) {
  const Cloud cloud = lidar({.rings = 32, .azimuth_step = 1});
  const auto elevation = [&](int i) { return std::asin(cloud.points(i, 2) / cloud.points.row(i).norm()); };
  const double degree = std::atan(1.0) / 45;
  EXPECT_NEAR(elevation(0), -30.67 * degree, 1e-12);
  EXPECT_NEAR(elevation(31 * cloud.width), 10.67 * degree, 1e-12);
}

TEST(Scanners, LidarStartsAtItsFirstAzimuth) {
  const Cloud cloud = lidar({.azimuth_step = 2, .first_azimuth = 0.25});
  EXPECT_NEAR(std::atan2(cloud.points(3, 1), cloud.points(3, 0)), 3.25 * 2 * std::atan(1.0) / 45, 1e-12);
}

// Four by three rays on the plane z = 0, of which one column is on another plane.
Cloud smallScan() {
  Cloud scan{.points = Points::Zero(12, 3), .labels = std::vector<int>(12, 0), .width = 4, .height = 3};
  for (int i = 0; i < 12; ++i) scan.points.row(i) << i % 4, i / 4, 0;
  return scan;
}

TEST(ScanTruth, AreaIsThatOfTheTrianglesOnOneSurface) {
  Cloud scan = smallScan();
  EXPECT_DOUBLE_EQ(scanTruth(scan, false).area, 6);
  scan.labels[5] = 1;  // a corner of four cells, each of which keeps the triangle of its other corners
  EXPECT_DOUBLE_EQ(scanTruth(scan, false).area, 4);
  scan.labels[6] = 1;  // two cells now have two corners on each surface
  EXPECT_DOUBLE_EQ(scanTruth(scan, false).area, 2);
}

TEST(ScanTruth, InnerRaysHaveEightNeighboursOnTheirSurface) {
  Cloud scan = smallScan();
  const auto inner = [&](bool goes_round) {
    int count = 0;
    for (const int flag : scanTruth(scan, goes_round).inner) count += flag;
    return count;
  };
  EXPECT_EQ(inner(false), 2);
  EXPECT_EQ(inner(true), 4);
  scan.labels[0] = 1;
  EXPECT_EQ(inner(false), 1);
  EXPECT_EQ(inner(true), 1);
}

TEST(ScanTruth, OfALidarRoomIsNearlyTheAreaSeen) {
  // Only strips between surfaces, and between rays of grazing incidence, are missing.
  const Cloud cloud = lidar({.rings = 64, .azimuth_step = 0.5});
  const ScanTruth truth = scanTruth(cloud, true);
  EXPECT_LT(truth.area, cloud.area);
  EXPECT_GT(truth.area, 0.9 * cloud.area);
}

TEST(Scanners, AJumpIsWhereTheScannerSeesPastAnEdge) {
  const Eigen::Vector3d floor_before_box(2.8, -2, -1.8), box_front(3, -2, -1.5), box_top(4, -2, -0.3);
  const Eigen::Vector3d east_wall(11, -4, 0.5), south_wall(10, -6, 0.5);
  EXPECT_FALSE(crossesJump(floor_before_box, box_front));
  EXPECT_FALSE(crossesJump(box_front, box_top));
  EXPECT_FALSE(crossesJump(south_wall, east_wall));
  EXPECT_TRUE(crossesJump(box_top, east_wall));
  EXPECT_TRUE(crossesJump(east_wall, box_front));
}

TEST(Scanners, DepthCameraIsQuantisedAndOrganized) {
  const DepthCameraOptions options{.width = 160, .height = 120, .depth_step = 0.004};
  const Cloud cloud = depthCamera(options);
  ASSERT_EQ(cloud.points.rows(), 160 * 120);
  int holes = 0;
  std::set<int> seen;
  for (int i = 0; i < 160 * 120; ++i) {
    const Eigen::RowVector3d p = cloud.points.row(i);
    if (std::isnan(p.z())) {
      EXPECT_TRUE(std::isnan(p.x()) && std::isnan(p.y()));
      ++holes;
      continue;
    }
    EXPECT_NEAR(p.z() / options.depth_step, std::round(p.z() / options.depth_step), 1e-9);
    EXPECT_LE(p.z(), options.max_depth);
    EXPECT_NEAR(p.x() / p.z(), (i % 160 - 79.5) / (525.0 / 4), 1e-12);
    EXPECT_NEAR(p.y() / p.z(), (i / 160 - 59.5) / (525.0 / 4), 1e-12);
    EXPECT_LT(cloud.normals.row(i).dot(p), 0);
    seen.insert(cloud.labels[i]);
  }
  EXPECT_GT(holes, 100);
  EXPECT_LT(holes, 160 * 120 / 3);
  EXPECT_GE(seen.size(), 4u);  // floor, two walls or more, box
}

}  // namespace
}  // namespace tufted::shapes::scanners_test
