// The Laplacian by the scan's own structure: the same promises, and the surfaces that a scanner sees.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "guarantees/guarantees.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::structure_test {
namespace {

Laplacian build(const Points& points, const ScanStructure& structure, Preset preset = Preset::clean, int threads = 0) {
  CloudOptions options = cloudOptions(preset);
  options.structure = &structure;
  options.threads = threads;
  Laplacian laplacian = pointCloudLaplacian(points, options);
  for (const std::string& broken : guarantees::brokenGuarantees(laplacian, points)) ADD_FAILURE() << broken;
  return laplacian;
}

ScanStructure ringsOf(const shapes::Cloud& scan) {
  return ringStructure(scan.points, imageStructure(scan.width, scan.height).row);
}

int countOpen(const Laplacian& laplacian, int from, int to) {
  const auto begin = laplacian.boundary.begin();
  return to - from - static_cast<int>(std::count(begin + from, begin + to, Boundary::none));
}

TEST(ImageStructure, GivesTheLaplacianOfTheTreeWhereTheSurfaceIsSmooth) {
  // A bowl; within 12 pixels of the rim windows end where balls do not.
  constexpr int width = 70, height = 60;
  Points points(width * height, 3);
  for (int i = 0; i < points.rows(); ++i) {
    const double u = (i % width - 34.3) / 100, v = (i / width - 29.6) / 100;
    points.row(i) = Eigen::RowVector3d(u, v, 1) * (2 - u * u - 0.7 * v * v + 0.1 * u * v);
  }
  const CloudOptions exact{.mollify = 0};
  CloudOptions by_image = exact;
  const ScanStructure structure = imageStructure(width, height);
  by_image.structure = &structure;
  const SparseMatrix expected = pointCloudLaplacian(points, exact).L, L = pointCloudLaplacian(points, by_image).L;
  // Tangent planes are fitted in other ways: in the middle, where four points have nearly one circle, a star may take
  // the other diagonal.
  const SparseMatrix difference = L - expected;
  int entries = 0, others = 0;
  for (int i = 0; i < L.cols(); ++i) {
    const int column = i % width, row = i / width;
    if (std::min({column, row, width - 1 - column, height - 1 - row}) < 12) continue;
    for (SparseMatrix::InnerIterator entry(difference, i); entry; ++entry) {
      ++entries;
      others += std::abs(entry.value()) > 1e-12 ? 1 : 0;
    }
  }
  EXPECT_LT(others, 0.01 * entries);
}

TEST(ImageStructure, JoinsNothingAcrossADepthJump) {
  constexpr int width = 60, height = 40;
  Points points(width * height, 3);
  const auto isNear = [](int i) { return std::hypot(i % width - 30, i / width - 20) < 10; };
  for (int i = 0; i < points.rows(); ++i) {
    const double u = (i % width - 30) / 100.0, v = (i / width - 20) / 100.0;
    points.row(i) = Eigen::RowVector3d(u, v, 1) * (isNear(i) ? 0.85 : 1.0);
  }
  for (const Preset preset : {Preset::clean, Preset::scan}) {
    const Laplacian laplacian = build(points, imageStructure(width, height), preset);
    EXPECT_EQ(laplacian.report.components, 2);
    EXPECT_GT(laplacian.report.cut_neighbors, 0);
    for (int i = 0; i < laplacian.L.cols(); ++i) {
      for (SparseMatrix::InnerIterator entry(laplacian.L, i); entry; ++entry)
        EXPECT_EQ(isNear(static_cast<int>(entry.row())), isNear(i));
    }
  }
}

TEST(ImageStructure, TakesHolesAndNoiseAsTheyCome) {
  const auto scan = shapes::depthCamera({.width = 80, .height = 60, .depth_step = 0.05, .dropouts = 0.3}, 2);
  for (const Preset preset : {Preset::clean, Preset::scan, Preset::lidar}) {
    const Laplacian laplacian = build(scan.points, imageStructure(scan.width, scan.height), preset);
    EXPECT_GT(laplacian.report.not_finite, 0);
    EXPECT_GT(laplacian.report.active, 2000);
  }
}

TEST(ImageStructure, OfOneRowHasNoSurface) {
  Points points(20, 3);
  for (int i = 0; i < 20; ++i) points.row(i) << 0.1 * i, 0, 1;
  EXPECT_EQ(build(points, imageStructure(20, 1)).report.active, 0);
  EXPECT_EQ(build(points, imageStructure(1, 20)).report.active, 0);
  EXPECT_EQ(build(Points(0, 3), imageStructure(0, 0)).report.points, 0);
  EXPECT_EQ(build(points.topRows(1), imageStructure(1, 1)).report.isolated, 1);
}

TEST(RingStructure, ClosesACylinderAroundItsSensor) {
  // 23 times as far between rings as along them; every star but those of the outermost rings is closed.
  constexpr int rings = 10, steps = 1440;
  Points points(rings * steps, 3);
  for (int i = 0; i < points.rows(); ++i) {
    const double angle = 2 * std::numbers::pi * (i % steps + 0.31) / steps;
    points.row(i) << std::cos(angle), std::sin(angle), 0.1 * (i / steps - 4);
  }
  for (const Preset preset : {Preset::clean, Preset::lidar}) {
    const Laplacian laplacian = build(points, findRings(points), preset);
    EXPECT_EQ(laplacian.report.components, 1);
    EXPECT_EQ(countOpen(laplacian, steps, (rings - 1) * steps), 0);
    EXPECT_EQ(countOpen(laplacian, 0, steps), steps);
    // Masses beside an open star are not Voronoi areas.
    const double inner = laplacian.M.segment(2 * steps, (rings - 4) * steps).sum();
    EXPECT_NEAR(inner, 2 * std::numbers::pi * 0.1 * (rings - 4), 0.005 * inner);
  }
}

TEST(ImageStructure, FindsNeighborsAcrossPixelsWithoutAPoint) {
  // Every fourth pixel of every fourth row.
  const int side = 40;
  const Points points = shapes::squareLattice(side, 1).points;
  ScanStructure sparse = imageStructure(side, side, {side / 2, side / 2, -side});
  for (int& row : sparse.row) row *= 4;
  for (double& column : sparse.position) column *= 4;
  const Laplacian laplacian = build(points, sparse, Preset::scan);
  EXPECT_EQ(laplacian.report.active, side * side);
  EXPECT_EQ(countOpen(laplacian, 0, side * side), 4 * (side - 1));
  EXPECT_NEAR(laplacian.report.area, (side - 1) * (side - 1), 1e-9 * side * side);
}

TEST(ImageStructure, OfFewUsablePointsIsAnImageAllTheSame) {
  // More than 2^24 pixels, and 64 for each entry but not for each point that is finite.
  const int width = 20000, height = 900, entries = 300000;
  Points points = Points::Constant(entries, 3, std::numeric_limits<double>::quiet_NaN());
  ScanStructure structure = imageStructure(entries, 1);
  for (int i = 0; i < entries; ++i) {
    structure.row[i] = i % height;
    structure.position[i] = (i * 67LL) % width;
  }
  structure.row.front() = 0, structure.position.front() = 0;
  structure.row.back() = height - 1, structure.position.back() = width - 1;
  for (const int i : {0, entries - 1}) points.row(i) << structure.position[i], structure.row[i], 1000;
  EXPECT_EQ(build(points, structure).report.isolated, 2);
  structure.position.back() = 100 * width;
  EXPECT_THROW(build(points, structure), InvalidInput);
}

TEST(ImageStructure, OfAPartFarFromTheFirstPixelIsThatOfThePart) {
  const shapes::Cloud camera = shapes::depthCamera({.width = 64, .height = 48});
  const ScanStructure image = imageStructure(64, 48);
  ScanStructure part = image;
  for (int& row : part.row) row += 1 << 30;
  for (double& column : part.position) column += 1 << 30;
  EXPECT_TRUE(support::sameBits(build(camera.points, part).L, build(camera.points, image).L));
}

TEST(RingStructure, OfTwoPointsEachIsAStrip) {
  Points points(2 * 40, 3);
  std::vector<int> ring;
  for (int i = 0; i < 80; ++i) {
    points.row(i) << (i % 2 == 0 ? 0.5 : -0.5), 0, i / 2;
    ring.push_back(i / 2);
  }
  const Laplacian laplacian = build(points, ringStructure(points, ring), Preset::lidar);
  EXPECT_EQ(laplacian.report.active, 80);
  EXPECT_EQ(laplacian.report.components, 1);
}

TEST(RingStructure, ClosesTheRoomThatTheTreeLeavesOpen) {
  const auto scan = shapes::lidar({.rings = 32, .azimuth_step = 0.4});
  const auto inner = shapes::scanTruth(scan, true).inner;
  const auto closed = [&](const Laplacian& laplacian) {
    int count = 0;
    for (std::size_t i = 0; i < inner.size(); ++i)
      count += inner[i] != 0 && laplacian.boundary[i] == Boundary::none ? 1 : 0;
    return count;
  };
  const Laplacian by_rings = build(scan.points, ringsOf(scan), Preset::lidar);
  EXPECT_LT(closed(pointCloudLaplacian(scan.points, cloudOptions(Preset::clean))), 0.9 * closed(by_rings));
  EXPECT_GE(closed(by_rings), 0.96 * std::count(inner.begin(), inner.end(), 1));
}

TEST(RingStructure, WithAzimuthsOfOtherPointsIsRefused) {
  const std::string refusal = "pointCloudLaplacian: structure.position: points at nearly the same azimuth";
  shapes::Random random(5);
  for (const int rings : {16, 32, 64}) {
    const auto scan = shapes::lidar({.rings = rings, .azimuth_step = 1, .noise = 0.01});
    const ScanStructure right = ringsOf(scan);
    const auto n = static_cast<int>(scan.points.rows());
    const std::vector<int> shuffled = random.permutation(n);
    const auto refused = [&](const std::function<double(int)>& azimuth) {
      ScanStructure structure = right;
      for (int i = 0; i < n; ++i) structure.position[i] = azimuth(i);
      CloudOptions options = cloudOptions(Preset::lidar);
      options.structure = &structure;
      return support::refusal([&] { pointCloudLaplacian(scan.points, options); }).starts_with(refusal);
    };
    EXPECT_TRUE(refused([](int) { return 0.0; })) << rings;
    EXPECT_TRUE(refused([&](int) { return 6 * random.uniform(); })) << rings;
    EXPECT_TRUE(refused([&](int i) { return right.position[shuffled[i]]; })) << rings;       // of another order
    EXPECT_TRUE(refused([&](int i) { return 37 * right.position[i]; })) << rings;            // of another unit
    EXPECT_TRUE(refused([&](int i) { return scan.points(i, 2); })) << rings << ": heights";  // of another field
    EXPECT_TRUE(refused([&](int i) { return i % 2 == 0 ? 0.0 : right.position[i]; })) << rings << ": half are missing";
    EXPECT_TRUE(refused([&](int i) { return 2 * i < n ? 0.0 : right.position[i]; })) << rings << ": half are missing";
    EXPECT_TRUE(refused([&](int i) { return i % 5 == 0 ? 0.0 : right.position[i]; }))
        << rings << ": a fifth is missing";
    EXPECT_FALSE(refused([&](int i) { return 1.3 - right.position[i]; })) << rings;
    EXPECT_FALSE(refused([&](int i) { return std::round(100 * right.position[i]) / 100; })) << rings << ": rounded";
    EXPECT_FALSE(refused([&](int i) { return right.position[i] + 0.02 * random.normal(); })) << rings << ": blurred";
  }
}

TEST(RingStructure, OfAScannerThatStandsElsewhereIsThatOfTheScanner) {
  // 64 rings are an image, which has its origin at the scanner. Around another axis they are no image.
  const auto scan = shapes::lidar({.rings = 64, .azimuth_step = 0.5, .noise = 0.01});
  const ScanStructure right = ringsOf(scan);
  const double area = build(scan.points, right, Preset::lidar).report.area;
  ScanStructure there = right;
  there.origin = Eigen::Vector3d(30, 20, 5);
  const Points moved = scan.points.rowwise() + there.origin.transpose();
  EXPECT_NEAR(build(moved, there, Preset::lidar).report.area, area, 1e-6 * area);
  // What was moved without its origin, or turned over, is found along the rings.
  const Points turned = scan.points * Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitX()).toRotationMatrix();
  for (const Points& points : {moved, turned}) {
    const Laplacian laplacian = build(points, right, Preset::lidar);
    EXPECT_EQ(laplacian.report.neighbors, 30);
    EXPECT_NEAR(laplacian.report.area, area, 0.1 * area);
  }
}

TEST(ScanStructure, PermutedOrOnMoreThreadsGivesTheSameBits) {
  const auto scan = shapes::lidar({.rings = 16, .azimuth_step = 2, .noise = 0.02}, 7);
  const auto n = static_cast<int>(scan.points.rows());
  const std::vector<int> source = shapes::Random(2).permutation(n);
  const Points shuffled = support::permuted(scan.points, source);
  for (const bool by_rings : {true, false}) {
    const ScanStructure structure = by_rings ? ringsOf(scan) : imageStructure(scan.width, scan.height);
    ScanStructure permuted = structure;
    for (int i = 0; i < n; ++i) {
      permuted.row[i] = structure.row[source[i]];
      permuted.position[i] = structure.position[source[i]];
    }
    const Laplacian laplacian = build(scan.points, structure, Preset::lidar, 1);
    EXPECT_TRUE(
        support::sameBits(build(shuffled, permuted, Preset::lidar, 3).L, support::permuted(laplacian.L, source)));
    EXPECT_TRUE(support::sameBits(build(scan.points, structure, Preset::lidar, 4).L, laplacian.L));
  }
}

TEST(ScanStructure, KeepsEveryPromiseWhereverItPutsThePoints) {
  shapes::Random random(11);
  for (int round = 0; round < 60; ++round) {
    const int n = 1 + static_cast<int>(random.uniform() * (round % 2 == 0 ? 12 : 300));
    Points points(n, 3);
    ScanStructure structure;
    structure.has_rings = round % 3 != 0;
    for (int i = 0; i < n; ++i) {
      const double kind = random.uniform();
      points.row(i) << random.uniform(), random.uniform(), random.uniform();
      if (kind < 0.1) points.row(i).setConstant(std::nan(""));
      if (kind > 0.9 && i > 0) points.row(i) = points.row(i - 1);
      if (kind > 0.4 && kind < 0.42) points.row(i) *= 1e90;
      structure.row.push_back(static_cast<int>(random.uniform() * 6) - 1);
      structure.position.push_back(structure.has_rings ? 20 * (random.uniform() - 0.5)
                                                       : std::floor(8 * random.uniform()));
    }
    SCOPED_TRACE("round " + std::to_string(round));
    try {
      build(points, structure, static_cast<Preset>(round % 3));
    } catch (const InvalidInput& error) {  // azimuths at random fit no points, but for a few
      EXPECT_TRUE(structure.has_rings && std::string(error.what()).find("azimuth") != std::string::npos)
          << error.what();
    }
  }
}

TEST(ScanStructure, OfASensorThatIsNowhereIsAMistake) {
  const shapes::Cloud camera = shapes::depthCamera({.width = 20, .height = 15});
  for (const double nowhere : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    ScanStructure structure = imageStructure(camera.width, camera.height, {0, nowhere, 0});
    for (const bool has_rings : {false, true}) {
      structure.has_rings = has_rings;
      EXPECT_EQ(support::refusal([&] { pointCloudLaplacian(camera.points, {.structure = &structure}); }),
                "pointCloudLaplacian: structure.origin is not finite, must be");
    }
    const Eigen::Vector3d viewpoint(nowhere, 0, 0);
    EXPECT_THROW(pointCloudLaplacian(camera.points, {.viewpoint = &viewpoint}), InvalidInput);
  }
}

TEST(ScanStructure, AndNeighborhoodsTogetherAreAMistake) {
  const Points points = Points::Random(12, 3);
  const Neighborhoods neighborhoods = Neighborhoods::Zero(12, 3);
  const ScanStructure structure = imageStructure(4, 3);
  const CloudOptions options{.neighborhoods = &neighborhoods, .structure = &structure};
  EXPECT_THROW(pointCloudLaplacian(points, options), InvalidInput);
}

}  // namespace
}  // namespace tufted::structure_test
