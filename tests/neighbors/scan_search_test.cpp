#include "neighbors/scan/scan_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// A cloud with its ranks and the search by its structure.
struct Scan {
  explicit Scan(const Points& points, const ScanStructure& structure)
      : cloud(rankPoints(points, status, representative)),
        search(takeStructure(structure, cloud, status, representative, report)) {}

  /// The caller's indices of the neighbours of a point of the caller.
  std::vector<int> around(int point, int k) const {
    Buffer<Neighbor> found;
    search->nearest(rank(point), k, found);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    std::vector<int> points;
    for (const Neighbor& q : found) points.push_back(cloud.input_index[q.index]);
    return points;
  }

  int rank(int point) const {
    return static_cast<int>(std::find(cloud.input_index.begin(), cloud.input_index.end(), point) -
                            cloud.input_index.begin());
  }

  Report report;
  std::vector<PointStatus> status;
  std::vector<int> representative;
  RankedCloud cloud;
  std::unique_ptr<ScanSearch> search;
};

constexpr int width = 60, height = 50;

/// A plane as a pinhole camera sees it; its depth at the middle is 1.
Points plane(double slope_x, double slope_y) {
  Points points(width * height, 3);
  for (int i = 0; i < points.rows(); ++i) {
    const double u = (i % width - width / 2) / 100.0, v = (i / width - height / 2) / 100.0;
    points.row(i) = Eigen::RowVector3d(u, v, 1) / (1 - slope_x * u - slope_y * v);
  }
  return points;
}

TEST(ImageSearch, FindsTheNearestOfAllPointsOnPlanes) {
  // Where the image shears a plane, a few of the last may be other points at nearly the same distance.
  for (const auto& [x, y] : {std::pair(0.03, 0.01), std::pair(0.6, 0.1), std::pair(-0.2, 1.2), std::pair(1.5, 0.4)}) {
    const Points points = plane(x, y);
    const Scan scan(points, imageStructure(width, height));
    const NeighborSearch tree(scan.cloud.points);
    Buffer<Neighbor> found, expected;
    for (int p = 0; p < scan.cloud.size(); ++p) {
      const int column = scan.cloud.input_index[p] % width, row = scan.cloud.input_index[p] / width;
      if (std::min({column, row, width - 1 - column, height - 1 - row}) < 12) continue;
      scan.search->nearest(p, 30, found);
      tree.nearest(p, 30, expected);
      ASSERT_EQ(found.size(), expected.size());
      const bool is_sheared = std::abs(x) + std::abs(y) > 0.1;
      int common = 0;
      for (const Neighbor& q : found) common += std::binary_search(expected.begin(), expected.end(), q) ? 1 : 0;
      ASSERT_GE(common, is_sheared ? 27 : 30) << "slopes " << x << ' ' << y << " point " << p;
    }
  }
}

TEST(ImageSearch, NeverLooksAcrossADepthJump) {
  // From pixel to pixel the step to the nearer left part is within 4 degrees of the line of sight.
  Points points = plane(0.03, 0.01);
  for (int i = 0; i < points.rows(); ++i)
    if (i % width < 30) points.row(i) *= 0.85;
  const Scan scan(points, imageStructure(width, height));
  for (int i = 0; i < points.rows(); ++i) {
    for (const int q : scan.around(i, 60)) ASSERT_EQ(q % width < 30, i % width < 30) << i << " and " << q;
  }
  Buffer<Neighbor> found;
  const auto rank = std::find(scan.cloud.input_index.begin(), scan.cloud.input_index.end(), 25 * width + 30);
  const auto p = static_cast<int>(rank - scan.cloud.input_index.begin());
  EXPECT_GT(scan.search->nearest(p, 30, found).cut, 0);
}

TEST(ImageSearch, PassesOverPixelsWithoutAPoint) {
  Points points = plane(0.03, 0.01);
  shapes::Random random(3);
  for (int i = 0; i < points.rows(); ++i)
    if (random.uniform() < 0.2) points.row(i).setConstant(std::nan(""));
  const Scan scan(points, imageStructure(width, height));
  const NeighborSearch tree(scan.cloud.points);
  Buffer<Neighbor> found, expected;
  int equal = 0, inner = 0;
  for (int p = 0; p < scan.cloud.size(); ++p) {
    const int column = scan.cloud.input_index[p] % width, row = scan.cloud.input_index[p] / width;
    if (std::min({column, row, width - 1 - column, height - 1 - row}) < 12) continue;
    scan.search->nearest(p, 30, found);
    tree.nearest(p, 30, expected);
    ++inner;
    equal += found.size() == 30 && found.back().index == expected.back().index ? 1 : 0;
  }
  EXPECT_EQ(equal, inner);
}

TEST(ImageSearch, KnowsTrianglesThatSpanATearFromThoseOnASlant) {
  // A sheet slanted to the right and torn from row 15 down between two columns, each lip bent further back or forth
  // towards the bottom. A point above the tear is a neighbour of both lips.
  Points points(width * height, 3);
  for (int i = 0; i < points.rows(); ++i) {
    const int column = i % width, row = i / width;
    const double lip = std::max(0, row - 15) * (column < 30 ? -0.02 : 0.02);
    const bool is_missing = row > 30 && column > 25 && column < 35;
    const double depth = is_missing ? std::nan("") : 1 + lip + 0.01 * column;
    points.row(i) = Eigen::RowVector3d((column - 30) / 525.0, (row - 20) / 525.0, 1) * depth;
  }
  const Scan scan(points, imageStructure(width, height));
  const auto spansJump = [&](int row_a, int column_a, int row_b, int column_b, int row_c, int column_c) {
    const int a = scan.rank(row_a * width + column_a), b = scan.rank(row_b * width + column_b),
              c = scan.rank(row_c * width + column_c);
    EXPECT_EQ(scan.search->spansJump(a, b, c), scan.search->spansJump(c, a, b));
    EXPECT_EQ(scan.search->spansJump(a, b, c), scan.search->spansJump(b, a, c));
    return scan.search->spansJump(a, b, c);
  };
  EXPECT_FALSE(spansJump(12, 26, 12, 34, 8, 30));   // above, where the slant alone reaches a twentieth
  EXPECT_FALSE(spansJump(24, 20, 24, 29, 15, 25));  // on one lip
  EXPECT_TRUE(spansJump(20, 29, 20, 30, 14, 30));
  EXPECT_TRUE(spansJump(20, 28, 24, 31, 13, 29));
  EXPECT_TRUE(spansJump(40, 25, 40, 35, 29, 20));  // over pixels without a point
}

TEST(RingSearch, ReachesTheRingsBesideHoweverFarApartTheyAre) {
  // Rings of 3600 points on a cylinder, 100 times as far apart as the points on them.
  constexpr int rings = 7, steps = 3600;
  Points points(rings * steps, 3);
  std::vector<int> ring(points.rows());
  for (int i = 0; i < points.rows(); ++i) {
    const double angle = 2 * std::numbers::pi * (i % steps + 0.3) / steps;
    ring[i] = 10 * (i / steps);  // numbers need not be consecutive
    points.row(i) << std::cos(angle), std::sin(angle), 0.1 * 2 * std::numbers::pi * (i / steps - 3) / 3.6;
  }
  const Scan scan(points, ringStructure(points, ring));
  for (const int column : {0, 1, 17, 3599}) {
    const int p = 3 * steps + column;
    const std::vector<int> found = scan.around(p, 30);
    const auto has = [&](int row, int at) {
      return std::find(found.begin(), found.end(), row * steps + (at + steps) % steps) != found.end();
    };
    for (const int row : {2, 3, 4}) {
      for (const int step : {-2, -1, 1, 2}) EXPECT_TRUE(has(row, column + step)) << row << ' ' << column << ' ' << step;
    }
    EXPECT_TRUE(has(2, column) && has(4, column));
    EXPECT_LT(found.size(), 150U);
    EXPECT_EQ(std::count_if(found.begin(), found.end(), [&](int q) { return q / steps < 1 || q / steps > 5; }), 0);
  }
}

TEST(RingStructure, NumbersTheRingsByTheirElevations) {
  const auto scan = shapes::lidar({.rings = 16, .azimuth_step = 2, .noise = 0.02}, 4);
  EXPECT_EQ(findRings(scan.points).row, imageStructure(scan.width, scan.height).row);
  const Eigen::RowVector3d origin(100, -50, 7);
  const ScanStructure moved = findRings(scan.points.rowwise() + origin, origin.transpose());
  EXPECT_EQ(moved.row, imageStructure(scan.width, scan.height).row);
}

TEST(RingStructure, RefusesACloudWithoutRings) {
  EXPECT_THROW(findRings(shapes::torus(2000).points), InvalidInput);
  EXPECT_THROW(findRings(shapes::sphere(2000).points), InvalidInput);
  EXPECT_THROW(findRings(shapes::lidar({.azimuth_step = 2}).points, {1, 2, 0.5}), InvalidInput);
}

TEST(RingStructure, LeavesOutPointsWithoutADirection) {
  auto scan = shapes::lidar({.rings = 16, .azimuth_step = 2});
  scan.points.row(5).setZero();
  scan.points.row(6).setConstant(std::nan(""));
  const ScanStructure structure = findRings(scan.points);
  EXPECT_EQ(structure.row[5], -1);
  EXPECT_EQ(structure.row[6], -1);
  EXPECT_EQ(Scan(scan.points, structure).report.unplaced, 1);  // the other one is no point
}

TEST(ScanStructure, OfTheWrongSizeIsNamed) {
  EXPECT_THROW(imageStructure(-1, 3), InvalidInput);
  EXPECT_THROW(imageStructure(1 << 20, 1 << 20), InvalidInput);
  EXPECT_THROW(ringStructure(plane(0, 0), std::vector<int>{1, 2, 3}), InvalidInput);
  EXPECT_THROW(findRings(plane(0, 0), {0, 0, std::nan("")}), InvalidInput);
  EXPECT_THROW(Scan(plane(0, 0), imageStructure(width, height - 1)), InvalidInput);
  ScanStructure structure = imageStructure(width, height);
  structure.position[7] = 0.5;
  EXPECT_THROW(Scan(plane(0, 0), structure), InvalidInput);
  structure.position[7] = -1;
  EXPECT_THROW(Scan(plane(0, 0), structure), InvalidInput);
  structure.position[7] = 2e9;
  EXPECT_THROW(Scan(plane(0, 0), structure), InvalidInput);
}

}  // namespace
}  // namespace tufted
